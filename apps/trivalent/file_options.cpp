#include "file_options.h"

#include "trivalent/shell/option_names.h"

namespace trivalent::apps {

void add_digits_option(po::options_description& options) {
  options.add_options()("digits",
                        with_default_name(dual::Digits::ten_decimals, shell::digits_names),
                        "decimals: 10 decimals; 17: 17 significant digits, which keep every bit");
}

void add_file_options(po::options_description& options) {
  add_digits_option(options);
  options.add_options()("atom-style",
                        with_default_name(dual::AtomStyle::atomic, shell::atom_style_names),
                        "of LAMMPS data: atomic, or molecular with the bonds");
}

dual::Digits digits(const Session& session) {
  return named_value(session, "digits", shell::digits_names);
}

dual::AtomStyle atom_style(const Session& session) {
  return named_value(session, "atom-style", shell::atom_style_names);
}

}  // namespace trivalent::apps
