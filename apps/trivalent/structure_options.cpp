#include "structure_options.h"

#include <sstream>

#include "size_options.h"
#include "trivalent/formats/elements.h"
#include "trivalent/formats/structure_format.h"
#include "trivalent/shell/option_names.h"

namespace trivalent::apps {
namespace {

/// Symbols, also several in one word: C,H.
std::vector<potentials::Species> elements_of(const std::vector<std::string>& words) {
  std::vector<potentials::Species> elements;
  for (const std::string& word : words) {
    std::istringstream symbols(word);
    for (std::string symbol; std::getline(symbols, symbol, ',');) {
      const auto element = dual::element_of_symbol(symbol);
      if (!element) {
        throw UsageError(
            "--elements: '" + symbol +
            "' is not C or H (files come before this option, or another option between)");
      }
      elements.push_back(*element);
    }
  }
  return elements;
}

dual::ReadOptions read_options(const Session& session, const std::string& style_option) {
  dual::ReadOptions options = {.frame = session.find<int>("frame")};
  if (options.frame && *options.frame < 1) throw UsageError("--frame must be at least 1");
  if (const auto words = session.find<std::vector<std::string>>("elements")) {
    options.elements = elements_of(*words);
  }
  if (session.has(style_option)) {
    options.atom_style = named_value(session, style_option, shell::read_style_names);
  }
  return options;
}

std::string format_names() {
  std::string names;
  for (const dual::StructureFormat& format : dual::structure_formats()) {
    names += (names.empty() ? "" : ", ") + format.name;
  }
  return names;
}

}  // namespace

std::array<bool, 3> periodic_directions(const std::string& text) {
  if (text == "none") return {false, false, false};
  if (text.empty() || text.find_first_not_of("xyz") != std::string::npos) {
    throw UsageError("--periodic is made of x, y and z, or none, not '" + text + "'");
  }
  const auto has = [&](char axis) { return text.find(axis) != std::string::npos; };
  return {has('x'), has('y'), has('z')};
}

void add_structure_options(po::options_description& options, const std::string& style_option) {
  po::options_description atoms("Reading atoms");
  const std::string format_help =
      "format of the file, whatever its name: " + format_names() + "; - is standard input";
  atoms.add_options()  //
      ("periodic", po::value<std::string>(),
       "periodic directions as in xyz, x, none; default: as the file says; LAMMPS data: xyz")  //
      ("format", po::value<std::string>(), format_help.c_str())                                //
      ("elements", po::value<std::vector<std::string>>()->multitoken(),
       "elements of LAMMPS's types 1, 2, ...: C H; default: as masses or symbols say")  //
      (style_option.c_str(), po::value<std::string>(),
       "of LAMMPS data: atomic, charge, bond, angle, molecular or full; default: as the file "
       "says")  //
      ("frame", po::value<int>(), "which of several structures in the file, from 1; default: last");
  po::options_description sizes("Size of the dual, if the file is a mesh");
  add_dual_size_options(sizes);
  options.add(atoms).add(sizes);
}

shell::StructureOptions structure_options(const Session& session, const std::string& style_option) {
  shell::StructureOptions options = {.size = dual_size(session),
                                     .format = session.find<std::string>("format"),
                                     .reading = read_options(session, style_option)};
  if (const auto periodic = session.find<std::string>("periodic")) {
    options.periodic = periodic_directions(*periodic);
  }
  return options;
}

dual::Structure read_structure(const std::string& path, const shell::StructureOptions& options,
                               const Terminal& terminal) {
  dual::StructureFile file = shell::read_structure(path, options);
  terminal.notes(file.notes);
  return std::move(file.structure);
}

}  // namespace trivalent::apps
