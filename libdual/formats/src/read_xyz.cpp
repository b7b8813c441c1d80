#include <algorithm>
#include <limits>
#include <span>
#include <string_view>

#include "bond_columns.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/text_file.h"
#include "trivalent/formats/xyz.h"
#include "xyz_header.h"
#include "xyz_layout.h"

namespace trivalent::dual {
namespace {

using potentials::Species;

/// Symbols, atomic numbers, or LAMMPS's types, whose elements the options name.
class ElementReader {
 public:
  ElementReader(const LineReader& lines, std::span<const Species> elements)
      : lines_(lines), elements_(elements) {}

  Species read(std::string_view field) {
    if (const auto element = element_of_symbol(field)) return *element;
    const bool is_number = field.find_first_not_of("0123456789") == std::string_view::npos;
    if (is_number && !elements_.empty()) {
      const auto type = lines_.integer(field, 1, static_cast<std::int64_t>(elements_.size()));
      return elements_[static_cast<std::size_t>(type - 1)];
    }
    const auto element = element_of_number(field);
    if (!element) {
      lines_.fail("element ", in_quotes(field), "; the potentials know C and H",
                  is_number ? "; if this is a type of LAMMPS, --elements names its element" : "");
    }
    if (*element == Species::hydrogen && line_of_one_ == 0) line_of_one_ = lines_.line_number();
    return *element;
  }

  /// Refuses numbers that may as well be types: LAMMPS's `dump xyz` writes nothing but those.
  void check(const std::vector<Species>& species) const {
    const bool has_carbon = std::ranges::find(species, Species::carbon) != species.end();
    if (line_of_one_ == 0 || has_carbon) return;
    lines_.fail_at(line_of_one_,
                   "element '1' is the number of hydrogen or a type of LAMMPS; name the elements "
                   "of the types, as in --elements C");
  }

 private:
  const LineReader& lines_;
  std::span<const Species> elements_;
  std::size_t line_of_one_ = 0;  // the first; lines count from 1
};

/// The fields of one atom as numbers.
class RowReader {
 public:
  RowReader(const LineReader& lines, const std::vector<std::string_view>& fields)
      : lines_(lines), fields_(fields) {}

  [[nodiscard]] std::string_view field(std::size_t index) const { return fields_[index]; }
  [[nodiscard]] Eigen::Vector3d vector(std::size_t first) const {
    return {real(first), real(first + 1), real(first + 2)};
  }
  [[nodiscard]] int integer(std::size_t field) const {
    using Limits = std::numeric_limits<int>;
    return static_cast<int>(lines_.integer(fields_[field], Limits::min(), Limits::max()));
  }
  void append(std::vector<double>& values, std::size_t first) const {
    values.push_back(real(first));
  }
  void append(std::vector<int>& values, std::size_t first) const {
    values.push_back(integer(first));
  }
  void append(std::vector<Eigen::Vector3d>& values, std::size_t first) const {
    values.push_back(vector(first));
  }
  void append(std::vector<std::array<int, 3>>& values, std::size_t first) const {
    values.push_back({integer(first), integer(first + 1), integer(first + 2)});
  }

 private:
  [[nodiscard]] double real(std::size_t field) const { return lines_.fortran_real(fields_[field]); }

  const LineReader& lines_;
  const std::vector<std::string_view>& fields_;
};

std::int64_t read_count(LineReader& lines) {
  std::vector<std::string_view> fields;
  split_fields(lines.require("the number of atoms"), fields);
  if (fields.size() != 1) lines.fail("expected the number of atoms alone");
  return lines.integer(fields.front(), 0, std::numeric_limits<int>::max());
}

/// One structure of a file, read up to its comment line.
class FrameReader {
 public:
  FrameReader(LineReader& lines, const ReadOptions& options)
      : lines_(lines),
        n_atoms_(read_count(lines)),
        comment_(lines.require("the comment line")),
        elements_(lines, options.elements) {
    check_room(1);
  }

  StructureFile read() {
    StructureFile file;
    XyzLayout layout = plain_xyz_layout();
    // In plain XYZ the comment is free text, which may hold anything.
    if (XyzHeader::has_keys(comment_)) {
      const XyzHeader header(comment_, lines_);
      if (const auto properties = header.find("properties")) {
        layout = parse_xyz_layout(*properties, lines_);
      }
      file.structure.header = header.others();
      file.structure.atoms.box = header.box(lines_);
      file.notes = header.notes();
    } else {
      XyzHeader::check_free_text(comment_, lines_);
    }
    file.notes.insert(file.notes.end(), layout.notes.begin(), layout.notes.end());
    check_room(layout.n_fields);
    read_rows(layout, file);
    elements_.check(file.structure.atoms.species);
    return file;
  }

  /// Goes past the atoms without a look at them.
  void skip() {
    for (std::int64_t i = 0; i < n_atoms_; ++i) static_cast<void>(next_row(i));
  }

 private:
  std::string_view next_row(std::int64_t atom) {
    return lines_.require(concat("atom ", atom + 1, " of ", n_atoms_));
  }

  void check_room(std::size_t n_fields) const {
    // A field takes at least one character and one blank or line end; the last may lack it.
    const std::uint64_t shortest_row = 2 * n_fields;
    if (static_cast<std::uint64_t>(n_atoms_) * shortest_row <= lines_.n_remaining() + 1) return;
    lines_.fail("the file declares ", n_atoms_, " atoms, but only ", lines_.n_remaining(),
                " bytes follow; it is cut short or the count is wrong");
  }

  void read_rows(const XyzLayout& layout, StructureFile& file) {
    Structure& structure = file.structure;
    structure.columns = layout.columns;
    structure.atoms.positions.reserve(static_cast<std::size_t>(n_atoms_));
    structure.atoms.species.reserve(static_cast<std::size_t>(n_atoms_));
    BondColumns bonds;
    std::vector<std::string_view> fields;
    for (std::int64_t i = 0; i < n_atoms_; ++i) {
      split_fields(next_row(i), fields);
      const bool has_right_number = layout.may_have_more ? fields.size() >= layout.n_fields
                                                         : fields.size() == layout.n_fields;
      if (!has_right_number) {
        lines_.fail("expected ", layout.n_fields, " fields for an atom, found ", fields.size());
      }
      read_row(layout, RowReader(lines_, fields), structure, bonds);
    }
    take_network(layout, bonds, file);
  }

  void read_row(const XyzLayout& layout, const RowReader& row, Structure& structure,
                BondColumns& bonds) {
    std::size_t column = 0;
    for (const XyzProperty& property : layout.properties) {
      const std::size_t first = property.first_field;
      const auto integers = [&](std::vector<int>& values) {
        for (std::size_t i = 0; i < property.n_fields; ++i) row.append(values, first + i);
      };
      switch (property.role) {
        case XyzRole::element:
          structure.atoms.species.push_back(elements_.read(row.field(first)));
          break;
        case XyzRole::position:
          structure.atoms.positions.push_back(row.vector(first));
          break;
        case XyzRole::bonded_atoms:
          integers(bonds.atoms);
          break;
        case XyzRole::bonded_images:
          integers(bonds.images);
          break;
        case XyzRole::column:
          std::visit([&](auto& values) { row.append(values, first); },
                     structure.columns[column++].values);
          break;
        case XyzRole::left_out:
          break;
      }
    }
  }

  static void take_network(const XyzLayout& layout, BondColumns& bonds, StructureFile& file) {
    for (const XyzProperty& property : layout.properties) {
      if (property.role == XyzRole::bonded_atoms) bonds.width = property.n_fields;
    }
    if (bonds.width == 0) return;
    if (!bonds.images.empty() && bonds.images.size() != 3 * bonds.atoms.size()) {
      file.notes.push_back(concat(unused_bonds, BondColumns::images_name,
                                  " needs three numbers for each of ", BondColumns::atoms_name));
      return;
    }
    take_bonds(bonds, file.structure, file.notes);
  }

  LineReader& lines_;
  std::int64_t n_atoms_;
  std::string_view comment_;
  ElementReader elements_;
};

/// Goes past blank lines; false at the end of the file.
bool find_next_frame(LineReader& lines) {
  for (LineReader ahead = lines; const auto line = ahead.next(); lines = ahead) {
    if (!is_blank(*line)) return true;
  }
  return false;
}

struct FoundFrame {
  LineReader lines;  ///< in front of the structure
  int n_passed = 0;  ///< structures up to it, itself included
};

/// Finds the structure that the options ask for.
FoundFrame find_frame(LineReader lines, const ReadOptions& options) {
  FoundFrame found = {.lines = lines};
  while (true) {
    found.lines = lines;
    FrameReader(lines, options).skip();
    ++found.n_passed;
    if (options.frame && *options.frame == found.n_passed) return found;
    if (!find_next_frame(lines)) break;
  }
  if (options.frame) {
    lines.fail("the file has ", found.n_passed, " structures; there is no number ", *options.frame);
  }
  return found;
}

}  // namespace

StructureFile read_xyz(const std::filesystem::path& path, const ReadOptions& options) {
  const TextSource source = {.reader = "read_xyz", .path = path};
  if (options.atom_style) throw InvalidOption("read_xyz: only LAMMPS data have an atom_style");
  const std::string text = read_text(source);
  FoundFrame found = find_frame(LineReader(text, source), options);
  StructureFile file = FrameReader(found.lines, options).read();
  if (!options.frame && found.n_passed > 1) {
    file.notes.push_back(concat("the file has ", found.n_passed,
                                " structures; the last is read (--frame names another)"));
  }
  return file;
}

}  // namespace trivalent::dual
