// OpenEXR.

#include "fail.h"
#include "image.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <cstddef>

namespace koksma::loader {
namespace {

/// R, G, B, or Y three times.
std::vector<std::string> choose_channels(const Imf::ChannelList& channels, const std::string& name) {
    const auto has = [&](const char* c) { return channels.findChannel(c) != nullptr; };
    if (has("R") && has("G") && has("B")) return {"R", "G", "B"};
    if (has("Y") && !has("RY") && !has("BY")) return {"Y", "Y", "Y"};
    std::vector<std::string> all;
    for (auto it = channels.begin(); it != channels.end(); ++it) all.emplace_back(it.name());
    throw Error(fmt::format("{}: supported channels are R, G, B, or Y alone (A is dropped); the file has: {}", name, list_of(all)));
}

Image read(const std::filesystem::path& file) {
    Imf::InputFile in(file.string().c_str());
    const auto window = in.header().dataWindow();
    Image image{window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, {}};
    const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
    const auto channels = choose_channels(in.header().channels(), file.string());
    const bool gray = channels[0] == channels[1];
    image.texels.resize(width * height);
    Imf::FrameBuffer buffer;
    for (int c = 0; c < (gray ? 1 : 3); ++c) {
        const auto& name = channels[static_cast<std::size_t>(c)];
        const auto* channel = in.header().channels().findChannel(name);
        if (channel->xSampling != 1 || channel->ySampling != 1) throw Error(file.string() + ": subsampled channels are not supported");
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, &image.texels.front()[c], window, sizeof(Rgb), sizeof(Rgb) * width));
    }
    in.setFrameBuffer(buffer);
    in.readPixels(window.min.y, window.max.y);
    if (gray)
        for (Rgb& t : image.texels) t = Rgb(t.r);
    return image;
}

}  // namespace

Image decode_exr(const std::filesystem::path& file) {
    try {
        return read(file);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {
        throw Error(fmt::format("{}: cannot be decoded: {}", file.string(), e.what()));
    }
}

}  // namespace koksma::loader
