#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "io/file_bytes.h"
#include "io/mesh_readers.h"
#include "trivalent/remesh/error.h"
#include "volume/volume_readers.h"

namespace trivalent::remesh {

namespace {

/// NRRD's names for its types; it has int8 to uint64 too, as int8_t to uint64_t as well.
constexpr std::array nrrd_formats = {NamedFormat{"signed char", int8},
                                     NamedFormat{"uchar", uint8},
                                     NamedFormat{"unsigned char", uint8},
                                     NamedFormat{"short", int16},
                                     NamedFormat{"short int", int16},
                                     NamedFormat{"signed short", int16},
                                     NamedFormat{"signed short int", int16},
                                     NamedFormat{"ushort", uint16},
                                     NamedFormat{"unsigned short", uint16},
                                     NamedFormat{"unsigned short int", uint16},
                                     NamedFormat{"int", int32},
                                     NamedFormat{"signed int", int32},
                                     NamedFormat{"uint", uint32},
                                     NamedFormat{"unsigned int", uint32},
                                     NamedFormat{"longlong", int64},
                                     NamedFormat{"long long", int64},
                                     NamedFormat{"long long int", int64},
                                     NamedFormat{"signed long long", int64},
                                     NamedFormat{"signed long long int", int64},
                                     NamedFormat{"ulonglong", uint64},
                                     NamedFormat{"unsigned long long", uint64},
                                     NamedFormat{"unsigned long long int", uint64},
                                     NamedFormat{"float", float32},
                                     NamedFormat{"double", float64}};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find_first_not_of(" \t", at);
    if (begin == text.npos) break;
    at = std::min(text.find_first_of(" \t", begin), text.size());
    words.emplace_back(text.substr(begin, at - begin));
  }
  return words;
}

/// The text header and what stands behind it.
class NrrdReader {
 public:
  explicit NrrdReader(const Source& source) : source_(source) {
    if (!source.bytes.starts_with("NRRD000")) fail(source, "is no NRRD: it does not begin so");
    std::size_t at = 0;
    while (at < source.bytes.size()) {
      const std::size_t end = std::min(source.bytes.find('\n', at), source.bytes.size());
      const std::string_view line = trimmed(source.bytes.substr(at, end - at));
      at = std::min(end + 1, source.bytes.size());
      if (line.empty()) break;
      const std::size_t colon = line.find(": ");
      // Lines with ":=" are keys of the user.
      if (line.front() == '#' || colon == line.npos) continue;
      fields_[lower_case(std::string(line.substr(0, colon)))] = trimmed(line.substr(colon + 2));
    }
    data_ = source.bytes.substr(at);
  }

  Volume run() {
    Volume volume;
    read_sizes(volume);
    read_axes(volume);
    const std::string encoding = lower_case(field("encoding"));
    std::string other_file;
    const std::string name = fields_.contains("data file")  ? fields_.at("data file")
                             : fields_.contains("datafile") ? fields_.at("datafile")
                                                            : std::string();
    if (!name.empty()) {
      if (name.starts_with("LIST") || name.find('%') != name.npos) {
        fail(source_, "its values are in several files; save it as one");
      }
      other_file = read_bytes(std::filesystem::path(source_.name).parent_path() / name);
      data_ = other_file;
    }
    skip("line skip", "lineskip");
    if (encoding == "raw") {
      skip("byte skip", "byteskip");
      volume.values = values_of(source_, volume.size, array_of(data_));
    } else if (encoding == "gzip" || encoding == "gz") {
      constexpr std::size_t best_compression = 1100;
      const std::string unpacked = unpack({data_, source_.name}, best_compression);
      data_ = unpacked;
      skip("byte skip", "byteskip");
      volume.values = values_of(source_, volume.size, array_of(data_));
    } else if (encoding == "ascii" || encoding == "text" || encoding == "txt") {
      read_text(volume);
    } else {
      fail(source_,
           concat("its encoding is ", in_quotes(encoding), "; raw, gzip and ascii are read"));
    }
    return volume;
  }

 private:
  [[nodiscard]] const std::string& field(const std::string& name) const {
    const auto found = fields_.find(name);
    if (found == fields_.end()) fail(source_, concat("its header has no field '", name, "'"));
    return found->second;
  }

  [[nodiscard]] double number_in(std::string_view word, std::string_view name) const {
    const auto number = parse_number(word);
    if (!number) fail(source_, concat(name, ": ", in_quotes(word), " is no number"));
    return *number;
  }

  /// Sets the sizes and which axes of the file they are: those longer than 1, if there are more.
  void read_sizes(Volume& volume) {
    const std::vector<std::string> words = words_of(field("sizes"));
    const bool has_more = words.size() > 3;
    for (std::size_t k = 0; k < words.size(); ++k) {
      const auto length = parse_integer(words[k]);
      if (!length) fail(source_, concat("sizes: ", in_quotes(words[k]), " is no whole number"));
      if (has_more && *length == 1) continue;
      if (axes_.size() < 3) size_[axes_.size()] = *length;
      axes_.push_back(k);
    }
    if (axes_.size() != 3) {
      fail(source_, concat("its sizes are ", in_quotes(field("sizes")),
                           "; a volume has three axes and one value at each point"));
    }
    constexpr std::size_t not_by_size = std::numeric_limits<std::size_t>::max();
    static_cast<void>(checked_points(source_, size_, not_by_size));
    for (std::size_t k = 0; k < 3; ++k) volume.size[k] = static_cast<int>(size_[k]);
  }

  void read_axes(Volume& volume) const {
    for (const char* name : {"axis mins", "axismins", "axis maxs", "axismaxs"}) {
      if (!fields_.contains(name) || fields_.contains("space directions")) continue;
      const std::vector<std::string> words = words_of(field(name));
      const auto is_known = [&](const std::string& word) {
        return std::isfinite(number_in(word, name));  // nan: not known
      };
      if (std::ranges::none_of(words, is_known)) continue;
      fail(source_, concat("its header has the field '", name,
                           "', which is not read; give 'space directions' and 'space origin', "
                           "or 'spacings'"));
    }
    if (fields_.contains("space directions")) {
      const std::vector<std::string> vectors = vectors_in(field("space directions"));
      for (std::size_t k = 0; k < 3; ++k) {
        if (axes_[k] >= vectors.size()) fail(source_, "it has fewer space directions than axes");
        volume.steps.col(static_cast<Eigen::Index>(k)) = vector_in(vectors[axes_[k]]);
      }
    } else if (fields_.contains("spacings")) {
      read_spacings(volume);
    }
    if (fields_.contains("space origin")) volume.origin = vector_in(field("space origin"));
  }

  void read_spacings(Volume& volume) const {
    const std::vector<std::string> words = words_of(field("spacings"));
    for (std::size_t k = 0; k < 3; ++k) {
      if (axes_[k] >= words.size()) fail(source_, "it has fewer spacings than axes");
      const double spacing = number_in(words[axes_[k]], "spacings");
      const auto i = static_cast<Eigen::Index>(k);
      if (std::isfinite(spacing)) volume.steps(i, i) = spacing;  // nan: not known
    }
  }

  /// Words "(x,y,z)", with or without blanks in them, and "none".
  static std::vector<std::string> vectors_in(const std::string& text) {
    std::vector<std::string> vectors;
    std::string one;
    bool is_open = false;
    for (const char c : text + ' ') {
      if (c == '(') is_open = true;
      if (c == ')') is_open = false;
      if (c != ' ') one += c;
      if (c == ' ' && !is_open && !one.empty()) vectors.push_back(std::exchange(one, {}));
    }
    return vectors;
  }

  [[nodiscard]] Eigen::Vector3d vector_in(std::string text) const {
    std::erase_if(text, [](char c) { return c == '(' || c == ')'; });
    Eigen::Vector3d vector;
    std::string_view rest = text;
    for (double& x : vector) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      x = number_in(trimmed(rest.substr(0, comma)), "a vector of space");
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    return vector;
  }

  [[nodiscard]] NumberFormat format_of_values() const {
    const std::string type = lower_case(field("type"));
    if (const auto format = find_format(nrrd_formats, type)) return *format;
    std::string_view sized = type;
    if (sized.ends_with("_t")) sized.remove_suffix(2);
    if (const auto format = sized_format(sized)) return *format;
    fail(source_, concat("its values are of type ", in_quotes(type), ", which is not read"));
  }

  [[nodiscard]] NumberArray array_of(std::string_view bytes) const {
    const NumberFormat format = format_of_values();
    NumberArray array = {.bytes = bytes, .format = format};
    if (format.size > 1 && lower_case(field("endian")) == "big") {
      array.order = ByteOrder::big_endian;
    }
    // A negative skip counts from the end: the values are the file's last bytes.
    if (is_at_end_) {
      std::size_t wanted = format.size;
      for (const std::int64_t length : size_) wanted *= static_cast<std::size_t>(length);
      array.bytes = bytes.substr(bytes.size() - std::min(wanted, bytes.size()));
    }
    return array;
  }

  void skip(const std::string& name, const std::string& other_name) {
    const std::string& key = fields_.contains(name) ? name : other_name;
    if (!fields_.contains(key)) return;
    const double count = number_in(field(key), key);
    if (key.starts_with("byte") && count == -1.0) {
      is_at_end_ = true;
      return;
    }
    if (!(count >= 0.0 && count <= static_cast<double>(data_.size()))) {
      fail(source_, concat(key, " is ", count, ", of ", data_.size(), " bytes"));
    }
    if (key.starts_with("byte")) data_.remove_prefix(static_cast<std::size_t>(count));
    if (key.starts_with("byte")) return;
    for (double i = 0.0; i < count && !data_.empty(); ++i) {
      data_.remove_prefix(std::min(data_.find('\n'), data_.size() - 1) + 1);
    }
  }

  void read_text(Volume& volume) const {
    const Source text = {.bytes = data_, .name = source_.name};
    TextScanner scanner(text, Continuation::none);
    volume.values.resize(checked_points(source_, size_, data_.size()));
    for (float& value : volume.values) value = static_cast<float>(scanner.number("value"));
  }

  const Source& source_;
  std::map<std::string, std::string> fields_;
  std::string_view data_;
  std::array<std::int64_t, 3> size_ = {};
  std::vector<std::size_t> axes_;  ///< of the file, for each of the volume
  bool is_at_end_ = false;
};

}  // namespace

Volume read_nrrd(const Source& source) { return NrrdReader(source).run(); }

}  // namespace trivalent::remesh
