// Places in an environment map that are found some time before they are read, so that the map is in the cache by then.

KOKSMA_MATHS_BEGIN

/// @tparam kRows  most places at a time
template <std::size_t kRows>
class SkyPlaces {
public:
    /// Keeps the places of a pack of directions and has fetched what is read there.
    void find(const EnvironmentTable& table, std::size_t at, Mask active, const Vec3<Float>& wi) {
        const EnvironmentPlaceOf<Float> place = environment_place(table, wi);
        place.x.store(x_ + at);
        place.y.store(y_ + at);
        place.column.store(column_ + at);
        place.row.store(row_ + at);
        const Int32 first = (place.row * Int32(table.width + 1) + place.column) * Int32(4);
        prefetch(table.texels, active, first);
        prefetch(table.texels + 4 * (table.width + 1), active, first);
    }
    /// In lanes never found: the first cell or an old one, which the map has.
    [[nodiscard]] EnvironmentPlaceOf<Float> get(std::size_t at) const {
        return {Int32::load(column_ + at), Int32::load(row_ + at), Float::load(x_ + at), Float::load(y_ + at)};
    }

private:
    static constexpr std::size_t kRow = kRows + static_cast<std::size_t>(kLanes);
    alignas(64) float x_[kRow]{}, y_[kRow]{};
    alignas(64) std::int32_t column_[kRow]{}, row_[kRow]{};
};

KOKSMA_MATHS_END
