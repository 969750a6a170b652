// The random numbers of all paths of a batch, one bounce at a time.

KOKSMA_MATHS_BEGIN

/// Rows of numbers, filled by one call of the sampler for all paths in flight.
class BatchNumbers {
public:
    BatchNumbers(const TraceJob& job, TraceStats& stats) : plan_(job.plan), source_(job.source), stats_(stats) {
        std::uint32_t widest = dimension_count(plan_.layout.camera());
        for (std::size_t b = 0; b < plan_.layout.bounce_count(); ++b) {
            const std::uint32_t n = dimension_count(plan_.layout.bounce(b));
            widest = n > widest ? n : widest;
        }
        rows_.resize((std::size_t{widest} + 1) * detail::kBatchRow);
        for (first_ = rows_.data(); (reinterpret_cast<std::uintptr_t>(first_) & 63u) != 0;) ++first_;
    }

    void begin_batch() {
        constexpr std::uint64_t kTimedEvery = 32;  // batches: a clock is dear beside the fill of a group
        timed_ = batch_++ % kTimedEvery == 0;
    }
    [[nodiscard]] bool timed() const { return timed_; }
    void fill_camera(std::span<const SampleId> ids) { fill(ids, plan_.layout.camera(), 0); }
    /// @param queue  of the paths; later read for those that are filled
    void begin_bounce(std::size_t bounce, std::span<const SampleId> queue) {
        bounce_ = bounce;
        ids_ = queue;
        slots_ = bounce < plan_.bounces.size() ? &plan_.bounces[bounce] : nullptr;
    }
    /// The numbers of paths side by side in the queue, before any of theirs is asked for.
    void fill_bounce(std::size_t first, std::size_t count) {
        if (slots_ != nullptr) fill(ids_.subspan(first, count), plan_.layout.bounce(bounce_), first);
    }

    /// True where the bounce has slots: asking for a number does not draw it then.
    [[nodiscard]] bool are_laid_out() const { return slots_ != nullptr; }
    [[nodiscard]] Vec2<Float> film(std::size_t at) const { return {row(0, at), row(1, at)}; }
    [[nodiscard]] Vec2<Float> lens(std::size_t at) const {
        if (plan_.lens < 0) return {};  // a kernel with a lens, a scene without
        return {row(plan_.lens, at), row(plan_.lens + 1, at)};
    }
    [[nodiscard]] Float time(std::size_t at) const { return plan_.time < 0 ? Float(0.0f) : row(plan_.time, at); }
    /// @param at      place of the pack in the queue
    /// @param active  lanes that draw the number
    [[nodiscard]] Float get_1d(std::size_t at, Mask active, SlotRole role, std::int16_t BounceSlots::*member) {
        return slots_ != nullptr ? laid_out(slots_->*member, 0, at) : tail(at, active, role, 0);
    }
    [[nodiscard]] Vec2<Float> get_2d(std::size_t at, Mask active, SlotRole role, std::int16_t BounceSlots::*member) {
        if (slots_ == nullptr) return {tail(at, active, role, 0), tail(at, active, role, 1)};
        return {laid_out(slots_->*member, 0, at), laid_out(slots_->*member, 1, at)};
    }

private:
    [[nodiscard]] Float row(int r, std::size_t at) const { return Float::load(first_ + static_cast<std::size_t>(r) * detail::kBatchRow + at); }
    [[nodiscard]] Float laid_out(std::int16_t offset, int k, std::size_t at) const {
        return offset < 0 ? Float(0.0f) : row(offset + k, at);  // the kernel has an effect that the scene lacks: it does not use the number
    }
    [[nodiscard]] Float tail(std::size_t at, Mask active, SlotRole role, std::uint32_t k) {
        NumberLanes lanes(Float(0.0f));
        for_lanes(active, [&](int i) {
            ++stats_.tail_numbers;
            lanes.x[i] = tail_sample(source_.seed(), ids_[at + static_cast<std::size_t>(i)], static_cast<std::uint32_t>(bounce_), role, k);
        });
        return lanes.pack();
    }
    void fill(std::span<const SampleId> ids, SlotRun run, std::size_t at) {
        const double start = timed_ ? thread_seconds() : 0.0;
        source_.fill(ids, run, first_ + at, detail::kBatchRow);
        if (timed_) stats_.sampler_seconds += thread_seconds() - start;
    }

    const RenderPlan& plan_;
    const SampleSource& source_;
    TraceStats& stats_;
    std::vector<float> rows_;
    float* first_ = nullptr;  // aligned
    const BounceSlots* slots_ = nullptr;
    std::span<const SampleId> ids_;
    std::size_t bounce_ = 0;
    std::uint64_t batch_ = 0;
    bool timed_ = false;
};

KOKSMA_MATHS_END
