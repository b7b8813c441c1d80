#include "file_options.h"

namespace trivalent::apps {

namespace {

constexpr shell::Names<dual::Digits, 2> digits_names = {
    {{"decimals", dual::Digits::ten_decimals}, {"17", dual::Digits::seventeen_significant}}};
constexpr shell::Names<dual::AtomStyle, 2> atom_styles = {
    {{"atomic", dual::AtomStyle::atomic}, {"molecular", dual::AtomStyle::molecular}}};

}  // namespace

void add_digits_option(po::options_description& options) {
  options.add_options()("digits", with_default_name(dual::Digits::ten_decimals, digits_names),
                        "decimals: 10 decimals; 17: 17 significant digits, which keep every bit");
}

void add_file_options(po::options_description& options) {
  add_digits_option(options);
  options.add_options()("atom-style", with_default_name(dual::AtomStyle::atomic, atom_styles),
                        "of LAMMPS data: atomic, or molecular with the bonds");
}

dual::Digits digits(const Session& session) { return named_value(session, "digits", digits_names); }

dual::AtomStyle atom_style(const Session& session) {
  return named_value(session, "atom-style", atom_styles);
}

}  // namespace trivalent::apps
