#pragma once

#include <string>

#include "flat_drawing.h"
#include "trivalent/view/atom_maps.h"

namespace trivalent::dual {

/// Letters and colors of what is written beside the shells.
struct Pen {
  double size = 0.0;  ///< height of capitals [pixel]
  Color ink = {};
};

/// Draws what the colors of a map mean: its scale with three numbers, or its categories.
void draw_legend(FlatDrawing& drawing, const AtomMap& map, const Pen& pen, const Rectangle& area);

}  // namespace trivalent::dual
