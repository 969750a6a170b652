#include "mutant.h"

namespace koksma::mutation {

namespace {

class MutantSource final : public SampleSource {
public:
    MutantSource(const SamplerInfo& info, const SamplingPlan& plan, Value value)
        : SampleSource(plan.seed, info.max_dimensions), value_(value), spp_(plan.spp) {}

    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept override {
        for (const Slot& slot : run)
            for (std::uint32_t k = 0; k < slot.arity; ++k, out += stride)
                for (std::size_t i = 0; i < samples.size(); ++i)
                    out[i] = slot.dimension + slot.arity > tail_dimension()
                                 ? tail_sample(seed(), samples[i], slot.bounce, slot.role, k)
                                 : value_({.seed = seed(), .index = samples[i].index, .pixel = samples[i].pixel, .dimension = slot.dimension + k,
                                           .slot = slot.dimension, .arity = slot.arity, .spp = spp_});
    }

private:
    Value value_;
    std::uint64_t spp_;
};

class MutantFactory final : public SamplerFactory {
public:
    MutantFactory(SamplerInfo info, Value value) : info_(std::move(info)), options_(info_.name, {}, {}), value_(value) {}
    const SamplerInfo& info() const noexcept override { return info_; }
    const SamplerOptions& options() const noexcept override { return options_; }
    std::unique_ptr<SampleSource> bind(const SamplingPlan& plan) const override {
        if (plan.spp > info_.max_samples) throw Error("too many samples");
        return std::make_unique<MutantSource>(info_, plan, value_);
    }

private:
    SamplerInfo info_;
    SamplerOptions options_;
    Value value_;
};

}  // namespace

conformance::Subject subject(const Family& family, const std::string& name, Value value) {
    SamplerInfo info = family.info;
    info.name = family.name + "/" + name;
    conformance::Subject s;
    s.factory = std::make_shared<MutantFactory>(std::move(info), value);
    s.promises = family.promises;
    s.randomized = family.randomized;
    s.pixels_shared = !family.randomized;
    s.pixels_independent = family.randomized;
    return s;
}

std::vector<Family> all_families() {
    return {sobol_family(),   plain_sobol_family(),  padded_family(), rotated_family(), halton_family(),
            plain_halton_family(), jitter_family(), lhs_family(),     random_family()};
}

}  // namespace koksma::mutation
