#include "size_options.h"

#include <initializer_list>

#include "trivalent/shell/number_text.h"
#include "trivalent/shell/potential_choice.h"

namespace trivalent::apps {
namespace {

constexpr const char* length_help = "longest side of the bounding box [Å]";
constexpr const char* scale_help = "[Å per unit of the input]";

void allow_one(const Session& session, std::initializer_list<const char*> names) {
  std::string given;
  int count = 0;
  for (const char* name : names) {
    if (!session.has(name)) continue;
    given += (count++ > 0 ? " and --" : "--") + std::string(name);
  }
  if (count > 1) throw UsageError(given + " both say how large the shell is; give one");
}

}  // namespace

void add_shell_size_options(po::options_description& options) {
  const dual::ShellOptions defaults;
  const std::string bond_help =
      "mean bond length wanted [Å]; default: " + shell::significant(defaults.bond) +
      ", of several walls " + shell::significant(shell::usual_bond_length({.name = "airebo"})) +
      ", which suits AIREBO";
  const std::string atoms_help = "about so many atoms; default, if no size is given: " +
                                 std::to_string(dual::AtomCount{}.atoms);
  options.add_options()                                //
      ("atoms", po::value<int>(), atoms_help.c_str())  //
      ("length", po::value<double>(), length_help)     //
      ("scale", po::value<double>(), scale_help)       //
      ("bond", po::value<double>(), bond_help.c_str());
}

std::optional<dual::ShellSize> shell_size(const Session& session) {
  allow_one(session, {"atoms", "length", "scale"});
  if (const auto atoms = session.find<int>("atoms")) return dual::AtomCount{*atoms};
  if (const auto length = session.find<double>("length")) return dual::LongestSide{*length};
  if (const auto scale = session.find<double>("scale")) return dual::Scale{*scale};
  return std::nullopt;
}

void add_dual_size_options(po::options_description& options) {
  const std::string bond_help = "mean bond length [Å]; default, if no size is given: " +
                                shell::significant(dual::MeanBond().length);
  options.add_options()                             //
      ("length", po::value<double>(), length_help)  //
      ("scale", po::value<double>(), scale_help)    //
      ("bond", po::value<double>(), bond_help.c_str());
}

std::optional<dual::DualSize> dual_size(const Session& session) {
  allow_one(session, {"bond", "length", "scale"});
  if (const auto length = session.find<double>("length")) return dual::LongestSide{*length};
  if (const auto scale = session.find<double>("scale")) return dual::Scale{*scale};
  if (const auto bond = session.find<double>("bond")) return dual::MeanBond{*bond};
  return std::nullopt;
}

}  // namespace trivalent::apps
