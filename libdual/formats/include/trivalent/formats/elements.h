#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "trivalent/potentials/atoms.h"

namespace trivalent::dual {

/// A word in lower case; letters other than ASCII's stay.
[[nodiscard]] std::string lower_case(std::string_view text);

/// The element of a symbol, in any case; none for elements that the potentials do not know.
[[nodiscard]] std::optional<potentials::Species> element_of_symbol(std::string_view symbol);

/// The element of an atomic number, likewise.
[[nodiscard]] std::optional<potentials::Species> element_of_number(std::string_view number);

/// The element whose standard atomic weight a mass [u] is, to half a unit: programs write 12 or
/// 12.0107, 1 or 1.00794. Isotopes are not told apart.
[[nodiscard]] std::optional<potentials::Species> element_of_mass(double mass);

/// Whether a word is the symbol of any chemical element.
[[nodiscard]] bool is_element_symbol(std::string_view word);

/// The symbol of an element.
[[nodiscard]] std::string_view symbol_of(potentials::Species species);

}  // namespace trivalent::dual
