#include <koksma/film/atomic_file.h>
#include <koksma/film/exr.h>
#include <koksma/sampling/error.h>

#include <fmt/format.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <fstream>

namespace koksma {

std::vector<float> ExrImage::rgb() const {
    const auto plane = [&](const char* wanted) -> const std::vector<float>& {
        if (const auto it = channels.find(wanted); it != channels.end()) return it->second;
        if (const auto it = channels.find("Y"); it != channels.end()) return it->second;
        throw Error(fmt::format("the image has no channel {}; expected R, G, B or Y", wanted));
    };
    const std::vector<float>*planes[3] = {&plane("R"), &plane("G"), &plane("B")};
    std::vector<float> out(3 * planes[0]->size());
    for (std::size_t i = 0; i < planes[0]->size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) out[3 * i + c] = (*planes[c])[i];
    return out;
}

void ExrImage::set_rgb(const std::vector<float>& interleaved) {
    const char* names[3] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float>& plane = channels[names[c]];
        plane.resize(interleaved.size() / 3);
        for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = interleaved[3 * i + c];
    }
}

namespace {

/// Imf::OutputFile writes the last bytes in its destructor and swallows what goes wrong there (a full disk); close() tells.
class OutputStream final : public Imf::OStream {
public:
    explicit OutputStream(const std::filesystem::path& file) : OStream(file.string().c_str()), out_(file, std::ios::binary) { check(); }
    void write(const char c[], int n) override {
        out_.write(c, n);
        check();
    }
    std::uint64_t tellp() override { return static_cast<std::uint64_t>(static_cast<std::streamoff>(out_.tellp())); }
    void seekp(std::uint64_t pos) override {
        out_.seekp(static_cast<std::streamoff>(pos));
        check();
    }
    void close() {
        out_.close();
        check();
    }

private:
    void check() const {
        if (!out_) throw Error("the disk is full or the folder is not writable");
    }
    std::ofstream out_;
};

}  // namespace

void write_exr(const std::filesystem::path& file, const ExrImage& image) {
    write_atomically(file, [&](const std::filesystem::path& path) {
        const int full_width = image.display_width > 0 ? image.display_width : image.width;
        const int full_height = image.display_height > 0 ? image.display_height : image.height;
        const Imath::Box2i display({0, 0}, {full_width - 1, full_height - 1});
        const Imath::Box2i data({image.data_x, image.data_y}, {image.data_x + image.width - 1, image.data_y + image.height - 1});
        Imf::Header header(display, data);
        header.compression() = Imf::ZIP_COMPRESSION;
        for (const auto& [key, value] : image.attributes) header.insert(key, Imf::StringAttribute(value));
        Imf::FrameBuffer frame;
        for (const auto& [name, plane] : image.channels) {
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            // OpenEXR addresses pixels of the data window by their place on the display window.
            char* base = reinterpret_cast<char*>(const_cast<float*>(plane.data())) -
                         static_cast<std::ptrdiff_t>(sizeof(float)) * (image.data_x + std::ptrdiff_t{image.data_y} * image.width);
            frame.insert(name, Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * static_cast<std::size_t>(image.width)));
        }
        OutputStream stream(path);
        {
            Imf::OutputFile out(stream, header);
            out.setFrameBuffer(frame);
            out.writePixels(image.height);
        }
        stream.close();
    });
}

ExrImage read_exr(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) throw Error(fmt::format("cannot read {}: there is no such file", file.string()));
    try {
        Imf::InputFile in(file.string().c_str());
        const Imf::Header& header = in.header();
        const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
        ExrImage image;
        image.width = data.max.x - data.min.x + 1;
        image.height = data.max.y - data.min.y + 1;
        if (std::int64_t{image.width} * image.height > (std::int64_t{1} << 30)) throw Error("more than 2^30 pixels");
        image.data_x = data.min.x;
        image.data_y = data.min.y;
        image.display_width = display.max.x - display.min.x + 1;
        image.display_height = display.max.y - display.min.y + 1;
        for (auto it = header.begin(); it != header.end(); ++it)
            if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute())) image.attributes[it.name()] = text->value();
        Imf::FrameBuffer frame;
        for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
            std::vector<float>& plane = image.channels[it.name()];
            plane.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
            char* base = reinterpret_cast<char*>(plane.data()) -
                         static_cast<std::ptrdiff_t>(sizeof(float)) * (image.data_x + std::ptrdiff_t{image.data_y} * image.width);
            frame.insert(it.name(), Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * static_cast<std::size_t>(image.width)));
        }
        in.setFrameBuffer(frame);
        in.readPixels(data.min.y, data.max.y);
        return image;
    } catch (const std::exception& e) {
        throw Error(fmt::format("cannot read {} as OpenEXR: {}", file.string(), e.what()));
    }
}

}  // namespace koksma
