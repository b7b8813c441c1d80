#pragma once

#include <string>
#include <vector>

#include "trivalent/dual/structure.h"

namespace trivalent::dual {

/// What a file holds.
struct StructureFile {
  Structure structure = {};
  std::vector<std::string> notes = {};  ///< one sentence per kind of thing left out or assumed
};

}  // namespace trivalent::dual
