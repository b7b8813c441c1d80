#pragma once

#include <string>

#include "temporary_folder.h"
#include "trivalent/shell/structure_source.h"

namespace trivalent::dual {

/// A file of atoms of this name and text, as every command reads it.
inline StructureFile file_of(const std::string& name, const std::string& text,
                             const ReadOptions& options = {}) {
  const testing_support::TemporaryFolder folder;
  return shell::read_structure(folder.file(name, text), {.reading = options});
}

}  // namespace trivalent::dual
