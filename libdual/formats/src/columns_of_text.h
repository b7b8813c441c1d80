#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "trivalent/formats/digits.h"
#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// Appends three numbers to a line, each after a blank.
void append_vector(std::string& line, const Eigen::Vector3d& vector, Digits digits);

/// Appends a word to a line, with blanks before it up to the width.
void append_right(std::string& line, std::string_view word, std::size_t width);

/// Appends a number with so many decimals, with blanks before it up to the width.
void append_fixed(std::string& line, double value, int decimals, std::size_t width);

/// The element of an atom whose name is all that a file gives: C, CA and C12 are carbon, HO1 is
/// hydrogen; CL, CU, HE and HG are other elements, and none is returned.
[[nodiscard]] std::optional<potentials::Species> element_of_name(std::string_view name);

/// The characters from one column up to another, without blanks around them; columns count from 0,
/// and may lie beyond the end of the line.
[[nodiscard]] std::string_view columns_of(std::string_view line, std::size_t begin,
                                          std::size_t end);

}  // namespace trivalent::dual
