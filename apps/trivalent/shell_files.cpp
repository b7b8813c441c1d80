#include "shell_files.h"

namespace trivalent::apps {

void add_file_options(po::options_description& options) {
  options.add_options()  //
      ("digits", with_default(std::string("decimals")),
       "decimals: 10 decimals; 17: 17 significant digits, which keep every bit")  //
      ("atom-style", with_default(std::string("atomic")),
       "of LAMMPS data: atomic, or molecular with the bonds");
}

dual::Digits digits(const Session& session) {
  const auto& name = session.get<std::string>("digits");
  if (name == "decimals") return dual::Digits::ten_decimals;
  if (name == "17") return dual::Digits::seventeen_significant;
  throw UsageError("--digits is decimals or 17, not '" + name + "'");
}

dual::AtomStyle atom_style(const Session& session) {
  const auto& name = session.get<std::string>("atom-style");
  if (name == "atomic") return dual::AtomStyle::atomic;
  if (name == "molecular") return dual::AtomStyle::molecular;
  throw UsageError("--atom-style is atomic or molecular, not '" + name + "'");
}

}  // namespace trivalent::apps
