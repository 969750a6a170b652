#pragma once
// XML files to elements: <default>, $parameters, <include>, line and column.

#include "element.h"
#include "files.h"

#include <koksma/scene/load.h>

#include <filesystem>
#include <string>
#include <vector>

namespace koksma::loader {

struct XmlDocument {
    std::vector<Element> elements;  ///< children of <scene>, those of included files in the place of the <include>
    SourceLocation where;           ///< of the main <scene>
    std::string comment;            ///< the first comment of the main file
    SearchPath search;              ///< folders of <path>, and the main file's
};

/// Reads a scene file and what it includes. `overrides` win over every <default>.
/// @throws Error also for an override that nothing in the file uses
[[nodiscard]] XmlDocument read_xml(const std::filesystem::path& file, const SceneParameters& overrides);

}  // namespace koksma::loader
