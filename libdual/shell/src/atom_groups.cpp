#include "trivalent/shell/atom_groups.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "trivalent/dual/error.h"

namespace trivalent::shell {
namespace {

[[noreturn]] void complain(std::string_view group) {
  throw dual::InvalidOption(
      "atoms that stay (--fix) are edge, ids:1-9,12, sphere:x,y,z,radius or "
      "box:x0,y0,z0,x1,y1,z1, not '" +
      std::string(group) + "'");
}

template <typename Number>
Number parse(std::string_view text, std::string_view group) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) complain(group);
  return value;
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = std::min(text.find(','), text.size());
    parts.push_back(text.substr(0, end));
    if (end == text.size()) return parts;
    text.remove_prefix(end + 1);
  }
}

using Marks = std::vector<bool>;

void mark_edge(const std::vector<potentials::Bond>& bonds, Marks& marks) {
  std::vector<int> counts(marks.size(), 0);
  for (const auto& bond : bonds) {
    ++counts[bond.first];
    ++counts[bond.second];
  }
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = marks[i] || counts[i] < 3;
}

void mark_ids(std::string_view list, std::string_view group, Marks& marks) {
  for (const std::string_view part : split_at_commas(list)) {
    const std::size_t dash = std::min(part.find('-'), part.size());
    const auto first = parse<std::size_t>(part.substr(0, dash), group);
    const auto last =
        dash == part.size() ? first : parse<std::size_t>(part.substr(dash + 1), group);
    if (first < 1 || last < first) complain(group);
    if (last > marks.size()) {
      throw dual::InvalidOption("--fix " + std::string(group) + ": there are only " +
                                std::to_string(marks.size()) + " atoms");
    }
    for (std::size_t id = first; id <= last; ++id) marks[id - 1] = true;
  }
}

void mark_region(std::string_view numbers, std::string_view group, const potentials::Atoms& atoms,
                 Marks& marks) {
  std::vector<double> values;
  for (const auto part : split_at_commas(numbers)) values.push_back(parse<double>(part, group));
  const bool is_sphere = group.starts_with("sphere");
  if (values.size() != (is_sphere ? 4U : 6U)) complain(group);
  const Eigen::Vector3d from(values[0], values[1], values[2]);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Eigen::Vector3d& x = atoms.positions[i];
    const bool is_in = is_sphere ? (x - from).norm() <= values[3]
                                 : (x.array() >= from.array()).all() && x.x() <= values[3] &&
                                       x.y() <= values[4] && x.z() <= values[5];
    marks[i] = marks[i] || is_in;
  }
}

}  // namespace

std::vector<std::uint32_t> atoms_in_groups(const std::vector<std::string>& groups,
                                           const potentials::Atoms& atoms,
                                           const std::vector<potentials::Bond>& bonds) {
  Marks all(atoms.size(), false);
  for (const std::string& group : groups) {
    Marks marks(atoms.size(), false);
    const std::size_t colon = std::min(group.find(':'), group.size());
    const std::string_view kind = std::string_view(group).substr(0, colon);
    const std::string_view rest = std::string_view(group).substr(std::min(colon + 1, group.size()));
    if (group == "edge") {
      mark_edge(bonds, marks);
    } else if (kind == "ids") {
      mark_ids(rest, group, marks);
    } else if (kind == "sphere" || kind == "box") {
      mark_region(rest, group, atoms, marks);
    } else {
      complain(group);
    }
    if (std::ranges::count(marks, true) == 0) {
      throw dual::InvalidOption("--fix " + group + ": there is no such atom");
    }
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] || marks[i];
  }
  std::vector<std::uint32_t> fixed;
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (all[i]) fixed.push_back(i);
  }
  return fixed;
}

}  // namespace trivalent::shell
