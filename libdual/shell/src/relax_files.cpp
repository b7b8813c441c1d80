#include "relax_files.h"

#include <array>
#include <fstream>
#include <sstream>

#include "trivalent/formats/xyz.h"

namespace trivalent::shell {
namespace {

/// FNV-1a.
class Hash {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 1099511628211ULL;
  }
  template <typename Number>
  void add(const Number& number) {
    add(&number, sizeof number);
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

const double* find_number(const dual::Structure& structure, std::string_view key) {
  for (const dual::HeaderEntry& entry : structure.header) {
    if (entry.key == key) return std::get_if<double>(&entry.value);
  }
  return nullptr;
}

}  // namespace

std::string fingerprint(const potentials::Atoms& atoms, const potentials::RelaxOptions& options,
                        const std::string& potential) {
  Hash hash;
  for (const Eigen::Vector3d& x : atoms.positions) hash.add(x.data(), 3 * sizeof(double));
  for (const auto species : atoms.species) hash.add(species);
  hash.add(atoms.box.cell.data(), 9 * sizeof(double));
  for (const bool is_periodic : atoms.box.periodic) hash.add(is_periodic);
  for (const potentials::Bond& bond : options.bonds) {
    hash.add(bond.first);
    hash.add(bond.second);
    hash.add(bond.image.data(), sizeof bond.image);
  }
  for (const std::uint32_t atom : options.fixed) hash.add(atom);
  hash.add(options.minimizer);
  hash.add(options.box);
  hash.add(options.max_force);
  hash.add(options.energy_change);
  hash.add(options.max_steps);
  hash.add(options.checkpoint_every);
  const std::string words = potential + TRIVALENT_VERSION;
  hash.add(words.data(), words.size());
  std::ostringstream text;
  text << 'x' << std::hex << hash.value();  // no number, whatever the digits
  return text.str();
}

Trajectory::Trajectory(std::filesystem::path path, int every)
    : path_(std::move(path)), part_(path_), every_(every) {
  part_ += ".part";
}

void Trajectory::add(const potentials::RelaxProgress& state) {
  if (state.stage == potentials::RelaxStage::trial) return;
  if (state.steps % every_ != 0 || (last_step_ && state.steps <= *last_step_)) return;
  last_step_ = state.steps;
  std::ostringstream frame;
  std::vector<dual::HeaderEntry> header = {
      {.key = "step", .value = static_cast<double>(state.steps)}};
  if (state.energy) header.push_back({.key = "energy", .value = *state.energy});
  dual::write_xyz(frame, {.atoms = state.atoms, .header = std::move(header)});
  std::ofstream out(part_, std::ios::binary | std::ios::app);
  out << frame.str();
  out.flush();
  if (!out) throw dual::FileError("relax: " + part_.string() + " cannot be written");
  size_ += frame.str().size();
}

bool Trajectory::resume(std::uintmax_t size, int last_step) {
  std::error_code error;
  const std::uintmax_t present = std::filesystem::file_size(part_, error);
  if (error || present < size) return false;
  std::filesystem::resize_file(part_, size, error);
  if (error) return false;
  size_ = size;
  last_step_ = last_step;
  return true;
}

void Trajectory::start() {
  const std::ofstream out(part_, std::ios::binary | std::ios::trunc);
  if (!out) throw dual::FileError("relax: " + part_.string() + " cannot be written");
  size_ = 0;
  last_step_.reset();
}

void Trajectory::finish() {
  std::error_code error;
  std::filesystem::rename(part_, path_, error);
  if (error) {
    throw dual::FileError("relax: " + path_.string() + " cannot be written: " + error.message());
  }
}

void save_relaxation(const std::filesystem::path& path, const std::string& fingerprint,
                     const potentials::RelaxCheckpoint& state, std::uintmax_t trajectory_size) {
  const dual::Structure structure = {
      .atoms = state.atoms,
      .header = {{.key = "fingerprint", .value = fingerprint},
                 {.key = "steps", .value = static_cast<double>(state.steps)},
                 {.key = "evaluations", .value = static_cast<double>(state.evaluations)},
                 {.key = "trajectory_size", .value = static_cast<double>(trajectory_size)}}};
  dual::write_xyz(path, structure, dual::Digits::seventeen_significant);
}

std::optional<SavedRelaxation> load_relaxation(const std::filesystem::path& path,
                                               const std::string& fingerprint) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  dual::Structure structure = dual::read_xyz(path).structure;
  const double* steps = find_number(structure, "steps");
  const double* evaluations = find_number(structure, "evaluations");
  const double* size = find_number(structure, "trajectory_size");
  for (const dual::HeaderEntry& entry : structure.header) {
    const auto* text = std::get_if<std::string>(&entry.value);
    if (entry.key != "fingerprint" || text == nullptr || *text != fingerprint) continue;
    if (steps == nullptr || evaluations == nullptr || size == nullptr) return std::nullopt;
    return SavedRelaxation{.atoms = std::move(structure.atoms),
                           .steps = static_cast<int>(*steps),
                           .evaluations = static_cast<int>(*evaluations),
                           .trajectory_size = static_cast<std::uintmax_t>(*size)};
  }
  return std::nullopt;
}

}  // namespace trivalent::shell
