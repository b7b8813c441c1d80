#pragma once

#include <sstream>
#include <string>

#include "temporary_folder.h"
#include "trivalent/formats/xyz.h"

namespace trivalent::dual {

inline std::string xyz_text_of(const Structure& frame, Digits digits = Digits::ten_decimals) {
  std::ostringstream out;
  write_xyz(out, frame, digits);
  return out.str();
}

inline StructureFile xyz_file_of(const std::string& text) {
  const testing_support::TemporaryFolder folder;
  return read_xyz(folder.file("atoms.extxyz", text));
}

}  // namespace trivalent::dual
