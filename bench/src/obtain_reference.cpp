#include "obtain_reference.h"

#include "progress.h"
#include "reference_store.h"

#include <koksma/film/atomic_file.h>

#include <fmt/format.h>

namespace koksma {

Reference obtain_reference(const Experiment& e, const BenchScene& s, const Registry& registry, int threads) {
    if (const auto file = find_reference(s.key)) {
        Reference reference = load_reference(*file, s.key);
        require_agreement(reference);
        return reference;
    }
    const std::filesystem::path file = reference_cache() / reference_file_name(s.key);
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    require_writable(file);
    fmt::print(stderr, "koksma: there is no reference for {} yet; rendering it (kept in {})\n", s.what.name, file.parent_path().string());
    Progress progress("reference " + s.what.name, true);
    Reference reference = make_reference(
        s.scene, s.plan, s.key, e, e.reference.spp, registry, threads, [&](double f) { progress.update(f); }, steps_of(file));
    save_reference(file, reference);
    return reference;
}

}  // namespace koksma
