#include "lammps_header.h"

#include <Eigen/LU>
#include <algorithm>

namespace trivalent::dual {
namespace {

constexpr std::array<std::string_view, 20> count_names = {"atoms",
                                                          "bonds",
                                                          "angles",
                                                          "dihedrals",
                                                          "impropers",
                                                          "atom types",
                                                          "bond types",
                                                          "angle types",
                                                          "dihedral types",
                                                          "improper types",
                                                          "extra bond per atom",
                                                          "extra angle per atom",
                                                          "extra dihedral per atom",
                                                          "extra improper per atom",
                                                          "extra special per atom",
                                                          "ellipsoids",
                                                          "lines",
                                                          "triangles",
                                                          "bodies",
                                                          "molecules"};
constexpr std::array<std::string_view, 3> side_names = {"xlo xhi", "ylo yhi", "zlo zhi"};
constexpr std::array<std::string_view, 3> vector_names = {"avec", "bvec", "cvec"};

Eigen::Vector3d vector_of(const LammpsLines& lines) {
  const auto& fields = lines.fields();
  return {lines.reader().real(fields[0]), lines.reader().real(fields[1]),
          lines.reader().real(fields[2])};
}

}  // namespace

LammpsHeader::LammpsHeader(LammpsLines& lines) {
  while (lines.advance()) {
    if (lines.is_section_name()) {
      has_section_ = true;
      break;
    }
    read_line(lines);
  }
  check(lines.reader());
}

void LammpsHeader::read_line(const LammpsLines& lines) {
  if (!read_side(lines) && !read_vector(lines)) read_count(lines);
}

bool LammpsHeader::read_side(const LammpsLines& lines) {
  const LineReader& reader = lines.reader();
  const auto found = std::ranges::find(side_names, lines.words_from(2));
  if (found == side_names.end()) return false;
  auto& side = sides_[static_cast<std::size_t>(found - side_names.begin())];
  if (side) reader.fail("a second line ", *found);
  side = {reader.real(lines.fields()[0]), reader.real(lines.fields()[1])};
  if (!((*side)[0] < (*side)[1])) reader.fail("the box has no extent here");
  return true;
}

bool LammpsHeader::read_vector(const LammpsLines& lines) {
  const std::string name = lines.words_from(3);
  std::optional<Eigen::Vector3d>* vector = nullptr;
  const auto found = std::ranges::find(vector_names, name);
  if (found != vector_names.end()) {
    vector = &vectors_[static_cast<std::size_t>(found - vector_names.begin())];
  } else if (name == "abc origin") {
    vector = &origin_;
  } else if (name == "xy xz yz") {
    vector = &tilts_;
  } else {
    return false;
  }
  if (*vector) lines.reader().fail("a second line ", name);
  *vector = vector_of(lines);
  return true;
}

void LammpsHeader::read_count(const LammpsLines& lines) {
  const LineReader& reader = lines.reader();
  const std::string name = lines.words_from(1);
  if (std::ranges::find(count_names, name) == count_names.end()) {
    reader.fail("line of the header, or name of a section, that LAMMPS does not know: ",
                in_quotes(lines.words_from(0)));
  }
  const bool is_new =
      counts_.emplace(name, reader.integer(lines.fields()[0], 0, max_lammps_id)).second;
  if (!is_new) reader.fail("a second line ", name);
}

void LammpsHeader::check(const LineReader& reader) const {
  if (!counts_.contains("atoms")) reader.fail("the header does not say how many atoms there are");
  for (const char* particles : {"ellipsoids", "lines", "triangles", "bodies"}) {
    if (count(particles) > 0) reader.fail("the file has ", particles, ", which are no atoms");
  }
  // The shortest row, "1 1 0 0 0" or "1 1 1 2", has four fields.
  constexpr std::uint64_t shortest_row = 8;
  for (const char* rows : {"atoms", "bonds"}) {
    if (static_cast<std::uint64_t>(count(rows)) <= reader.n_remaining() / shortest_row) continue;
    reader.fail("the file declares ", count(rows), ' ', rows, ", but only ", reader.n_remaining(),
                " bytes follow; it is cut short or the count is wrong");
  }
  const auto n_vectors =
      std::ranges::count_if(vectors_, [](const auto& v) { return v.has_value(); });
  const auto n_sides = std::ranges::count_if(sides_, [](const auto& s) { return s.has_value(); });
  if (n_vectors > 0 && (n_sides > 0 || tilts_)) {
    reader.fail("the header has both avec, bvec, cvec and xlo xhi or xy xz yz");
  }
  if (n_vectors != 0 && n_vectors != 3) reader.fail("the header lacks one of avec, bvec and cvec");
  if (origin_ && n_vectors == 0) reader.fail("abc origin goes with avec, bvec and cvec");
  if (n_vectors == 3 && !(box().cell.determinant() > 0.0)) {
    reader.fail("avec, bvec and cvec are not right-handed");
  }
}

std::int64_t LammpsHeader::count(const std::string& what) const {
  const auto found = counts_.find(what);
  return found == counts_.end() ? 0 : found->second;
}

bool LammpsHeader::has_box() const {
  return vectors_[0] ||
         std::ranges::all_of(sides_, [](const auto& side) { return side.has_value(); });
}

potentials::Box LammpsHeader::box() const {
  potentials::Box box;
  box.periodic = {true, true, true};
  if (vectors_[0]) {
    for (int i = 0; i < 3; ++i) box.cell.col(i) = *vectors_[static_cast<std::size_t>(i)];
    box.origin = origin_.value_or(Eigen::Vector3d::Zero());
    return box;
  }
  for (int i = 0; i < 3; ++i) {
    // LAMMPS's box if the header has none.
    const auto [low, high] = sides_[static_cast<std::size_t>(i)].value_or(std::array{-0.5, 0.5});
    box.origin[i] = low;
    box.cell(i, i) = high - low;
  }
  const Eigen::Vector3d tilts = tilts_.value_or(Eigen::Vector3d::Zero());
  box.cell(0, 1) = tilts[0];
  box.cell(0, 2) = tilts[1];
  box.cell(1, 2) = tilts[2];
  return box;
}

}  // namespace trivalent::dual
