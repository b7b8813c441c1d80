#include <muParser.h>

#include <cmath>
#include <numbers>

#include "trivalent/remesh/error.h"
#include "trivalent/remesh/level_set.h"

namespace trivalent::remesh {

struct Formula::Parser {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  mu::Parser parser;
};

Formula::Formula(const std::string& text) : parser_(std::make_unique<Parser>()) {
  mu::Parser& parser = parser_->parser;
  try {
    parser.DefineVar("x", &parser_->at.x());
    parser.DefineVar("y", &parser_->at.y());
    parser.DefineVar("z", &parser_->at.z());
    parser.DefineConst("pi", std::numbers::pi);
    parser.SetExpr(text);
    static_cast<void>(parser.Eval());
    if (parser.GetNumResults() != 1) {
      throw InvalidOption(concat("formula '", text, "': gives ", parser.GetNumResults(),
                                 " values, but must give one"));
    }
  } catch (const mu::ParserError& error) {
    const std::string& reason = error.GetMsg();
    const bool says_where = error.GetPos() < 0 || reason.find("position") != std::string::npos;
    throw InvalidOption(concat("formula '", text, "': ", reason,
                               says_where ? "" : concat(" (position ", error.GetPos(), ")")));
  }
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;

double Formula::operator()(const Eigen::Vector3d& p) const {
  parser_->at = p;
  return parser_->parser.Eval();
}

double number_of_formula(const std::string& text) {
  const Formula formula(text);
  const double here = formula(Eigen::Vector3d::Zero());
  if (!std::isfinite(here) || formula({0.3, 0.7, 1.1}) != here) {
    throw InvalidOption(concat("'", text, "' is no finite number"));
  }
  return here;
}

}  // namespace trivalent::remesh
