#pragma once
// Samplers by name. Filled explicitly by the register_samplers() that CMake generates for each program; no static initialisers.

#include <koksma/sampling/sample_source.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace koksma {

/// A sampler with its options fixed, ready to be bound to any number of plans.
class SamplerFactory {
public:
    virtual ~SamplerFactory() = default;
    [[nodiscard]] virtual const SamplerInfo& info() const noexcept = 0;
    [[nodiscard]] virtual const SamplerOptions& options() const noexcept = 0;
    /// @throws Error when the plan is beyond a limit of the sampler
    [[nodiscard]] virtual std::unique_ptr<SampleSource> bind(const SamplingPlan& plan) const = 0;

    /// The name with its options; keys result rows.
    [[nodiscard]] const std::string& name() const noexcept { return options().canonical(); }
    /// False for randomize=none: every seed gives the same points, so there are no replicates and no error bars.
    [[nodiscard]] bool randomized() const { return !options().has("randomize") || options()["randomize"] != "none"; }
};

namespace detail {
template <Sampler T>
class TypedFactory final : public SamplerFactory {
public:
    explicit TypedFactory(std::string_view given) : info_(T::info()), options_(info_.name, given, info_.options) {
        if constexpr (HasTables<T>) {
            tables_ = std::make_shared<const typename T::Tables>(options_);
            if constexpr (HasDescription<typename T::Tables>) tables_->describe(info_);
            if constexpr (HasChecksum<typename T::Tables>)
                if (!tables_->checksum().empty()) options_.resolve(info_.name, "checksum", tables_->checksum(), info_.options);
        }
    }
    const SamplerInfo& info() const noexcept override { return info_; }
    const SamplerOptions& options() const noexcept override { return options_; }
    std::unique_ptr<SampleSource> bind(const SamplingPlan& plan) const override {
        if (plan.spp > info_.max_samples)
            throw Error("sampler '" + name() + "' has " + std::to_string(info_.max_samples) + " samples per pixel at most; " +
                        std::to_string(plan.spp) + " were asked for");
        if constexpr (HasTables<T>)
            return std::make_unique<SourceWithTables>(options_, plan, tables_);
        else
            return std::make_unique<LiftedSource<T>>(options_, plan);
    }

private:
    static constexpr auto tables_type() {
        if constexpr (HasTables<T>)
            return std::type_identity<typename T::Tables>{};
        else
            return std::type_identity<int>{};
    }
    using TablesPtr = std::shared_ptr<const typename decltype(tables_type())::type>;
    /// Keeps the shared tables alive as long as the source that reads them.
    class SourceWithTables final : public SampleSource {
    public:
        SourceWithTables(const SamplerOptions& options, const SamplingPlan& plan, TablesPtr tables)
            : SampleSource(plan.seed, T::info().max_dimensions, BatchSampler<T>), tables_(std::move(tables)), source_(options, plan, *tables_) {}
        void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept override {
            source_.fill(samples, run, out, stride);
        }
        void fill_scalar(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept override {
            source_.fill_scalar(samples, run, out, stride);
        }

    private:
        TablesPtr tables_;
        LiftedSource<T> source_;
    };
    SamplerInfo info_;
    SamplerOptions options_;
    TablesPtr tables_;
};
}  // namespace detail

/// The samplers that a program knows.
class Registry {
public:
    /// @throws Error if the name is taken
    template <Sampler T>
    void add() {
        SamplerInfo info = T::info();
        for (const Entry& e : entries_)
            if (e.info.name == info.name) throw Error("two samplers are named '" + info.name + "'");
        entries_.push_back({std::move(info), BatchSampler<T>, [](std::string_view given) -> std::unique_ptr<SamplerFactory> {
                                return std::make_unique<detail::TypedFactory<T>>(given);
                            }});
        std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.info.name < b.info.name; });
    }

    /// @param spec  "name" or "name:option=value,option=value"
    /// @throws Error naming the known samplers, options or values
    [[nodiscard]] std::unique_ptr<SamplerFactory> make(std::string_view spec) const {
        const auto colon = spec.find(':');
        const std::string_view wanted = spec.substr(0, colon);
        std::string known;
        for (const Entry& e : entries_) {
            if (e.info.name == wanted) return e.make(colon == std::string_view::npos ? std::string_view{} : spec.substr(colon + 1));
            known += (known.empty() ? "" : ", ") + e.info.name;
        }
        throw Error("unknown sampler '" + std::string(wanted) + "'; known samplers: " + known);
    }

    [[nodiscard]] std::vector<SamplerInfo> infos() const {
        std::vector<SamplerInfo> all;
        for (const Entry& e : entries_) all.push_back(e.info);
        return all;
    }
    /// Whether the sampler brings a fill of its own.
    [[nodiscard]] bool vectorised(std::string_view name) const noexcept {
        return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.info.name == name && e.vectorised; });
    }
    [[nodiscard]] bool contains(std::string_view name) const noexcept {
        return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.info.name == name; });
    }

private:
    struct Entry {
        SamplerInfo info;
        bool vectorised;
        std::function<std::unique_ptr<SamplerFactory>(std::string_view)> make;
    };
    std::vector<Entry> entries_;
};

/// Generated by CMake for each program and module: adds the samplers it was linked with.
void register_samplers(Registry& registry);

}  // namespace koksma
