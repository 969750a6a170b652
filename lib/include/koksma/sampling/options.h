#pragma once
// A sampler's name with options, as typed: "sobol:randomize=owen,pixels=shared".

#include <koksma/sampling/error.h>

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace koksma {

/// One option of a sampler. `values` lists what is allowed; empty means free text.
struct OptionInfo {
    std::string name;
    std::string default_value;
    std::vector<std::string> values;
    std::string help;
    bool always_shown = false;  ///< part of the canonical name even at its default (the randomisation is)
};

/// The values of a sampler's options, defaults filled in and checked against its OptionInfo list.
class SamplerOptions {
public:
    SamplerOptions() = default;
    /// @param given  "key=value,key=value" or empty
    /// @throws Error naming the option, the allowed names or the allowed values
    SamplerOptions(std::string_view sampler, std::string_view given, const std::vector<OptionInfo>& known) {
        for (const OptionInfo& o : known) values_[o.name] = o.default_value;
        while (!given.empty()) {
            const auto comma = given.find(',');
            const std::string_view item = given.substr(0, comma);
            given = comma == std::string_view::npos ? std::string_view{} : given.substr(comma + 1);
            set(sampler, item, known);
        }
        make_canonical(sampler, known);
    }
    /// Sets a declared option to what set-up found (the checksum of a file), so that the canonical name says it.
    void resolve(std::string_view sampler, const std::string& key, std::string value, const std::vector<OptionInfo>& known) {
        if (!values_.contains(key)) throw Error("sampler option '" + key + "' is set but not declared in info().options");
        values_[key] = std::move(value);
        make_canonical(sampler, known);
    }
    /// The value of a declared option.
    [[nodiscard]] const std::string& operator[](const std::string& key) const {
        const auto it = values_.find(key);
        if (it == values_.end()) throw Error("sampler option '" + key + "' is read but not declared in info().options");
        return it->second;
    }
    [[nodiscard]] bool has(const std::string& key) const { return values_.contains(key); }
    /// The sampler's name with the options that matter, the key of result rows.
    [[nodiscard]] const std::string& canonical() const noexcept { return canonical_; }

private:
    void make_canonical(std::string_view sampler, const std::vector<OptionInfo>& known) {
        canonical_ = sampler;
        char separator = ':';
        for (const OptionInfo& o : known) {
            if (!o.always_shown && values_[o.name] == o.default_value) continue;
            canonical_ += separator + o.name + "=" + values_[o.name];
            separator = ',';
        }
    }
    void set(std::string_view sampler, std::string_view item, const std::vector<OptionInfo>& known) {
        const auto equals = item.find('=');
        const std::string key(item.substr(0, equals));
        std::string names;
        for (const OptionInfo& o : known) {
            names += (names.empty() ? "" : ", ") + o.name;
            if (o.name != key) continue;
            if (equals == std::string_view::npos)
                throw Error("sampler '" + std::string(sampler) + "': option '" + key + "' needs a value, as in " + key + "=" + o.default_value);
            const std::string value(item.substr(equals + 1));
            std::string allowed;
            for (const std::string& v : o.values) allowed += (allowed.empty() ? "" : ", ") + v;
            bool ok = o.values.empty();
            for (const std::string& v : o.values) ok = ok || v == value;
            if (!ok)
                throw Error("sampler '" + std::string(sampler) + "': " + key + "=" + value + " is not one of its values: " + allowed);
            values_[key] = value;
            return;
        }
        throw Error("sampler '" + std::string(sampler) + "' has no option '" + key + "'; its options are: " + (names.empty() ? "none" : names));
    }
    std::map<std::string, std::string> values_;
    std::string canonical_;
};

}  // namespace koksma
