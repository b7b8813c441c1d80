#pragma once

#include "trivalent/formats/digits.h"
#include "trivalent/formats/lammps_data.h"
#include "trivalent/potentials/relax.h"
#include "trivalent/remesh/crystallize.h"
#include "trivalent/remesh/mesh_repair.h"
#include "trivalent/remesh/remesh.h"
#include "trivalent/shell/build.h"
#include "trivalent/shell/names.h"
#include "trivalent/view/picture.h"

namespace trivalent::shell {

// Names of options, as the program and the Python module spell them.

inline constexpr Names<remesh::Effort, 3> effort_names = {{{"quick", remesh::Effort::quick},
                                                           {"normal", remesh::Effort::normal},
                                                           {"thorough", remesh::Effort::thorough}}};
inline constexpr Names<remesh::Follow, 3> follow_names = {{{"close", remesh::Follow::close},
                                                           {"carbon", remesh::Follow::carbon},
                                                           {"free", remesh::Follow::free}}};
inline constexpr Names<remesh::Restriction, 2> restriction_names = {
    {{"hard", remesh::Restriction::hard}, {"least-squares", remesh::Restriction::least_squares}}};

inline constexpr Names<remesh::RepairMethod, 3> repair_names = {
    {{"none", remesh::RepairMethod::none},
     {"safe", remesh::RepairMethod::safe},
     {"wrap", remesh::RepairMethod::wrap}}};
inline constexpr Names<remesh::HolePolicy, 2> hole_names = {
    {{"keep", remesh::HolePolicy::keep}, {"fill", remesh::HolePolicy::fill}}};
inline constexpr Names<remesh::ComponentPolicy, 2> component_names = {
    {{"all", remesh::ComponentPolicy::keep_all},
     {"largest", remesh::ComponentPolicy::keep_largest}}};

inline constexpr Names<dual::WallSide, 2> wall_side_names = {
    {{"outwards", dual::WallSide::outwards}, {"inwards", dual::WallSide::inwards}}};
inline constexpr Names<EdgeCap, 2> cap_names = {
    {{"none", EdgeCap::none}, {"hydrogen", EdgeCap::hydrogen}}};
inline constexpr Names<potentials::Minimizer, 2> minimizer_names = {
    {{"lbfgs", potentials::Minimizer::lbfgs}, {"fire", potentials::Minimizer::fire}}};

inline constexpr Names<dual::Digits, 2> digits_names = {
    {{"decimals", dual::Digits::ten_decimals}, {"17", dual::Digits::seventeen_significant}}};
inline constexpr Names<dual::AtomStyle, 2> atom_style_names = {
    {{"atomic", dual::AtomStyle::atomic}, {"molecular", dual::AtomStyle::molecular}}};
/// LAMMPS's atom_styles of data that can be read.
inline constexpr Names<dual::AtomStyle, 6> read_style_names = {
    {{"atomic", dual::AtomStyle::atomic},
     {"charge", dual::AtomStyle::charge},
     {"molecular", dual::AtomStyle::molecular},
     {"bond", dual::AtomStyle::molecular},
     {"angle", dual::AtomStyle::molecular},
     {"full", dual::AtomStyle::full}}};
inline constexpr Names<dual::PictureStyle, 2> picture_style_names = {
    {{"atoms", dual::PictureStyle::atoms}, {"rings", dual::PictureStyle::rings}}};

}  // namespace trivalent::shell
