// SPDX-License-Identifier: BSD-3-Clause
// What a map is in the eyes of a GIS: layers of points and lines with attributes. The exporters
// that write such files differ in the file only.
#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "cambium/context.hpp"
#include "cambium/params.hpp"
#include "cambium/stems.hpp"

namespace cambium::map_export {

enum class FieldType { integer, real, text, time };

struct Field {
  const char* name;
  FieldType type;
  int digits = 3;  ///< behind the point, where a real number becomes text
};

/// Nothing: not known. A Stamp is UTC.
using Value = std::variant<std::monostate, std::int64_t, double, std::string, Stamp>;

struct Feature {
  std::size_t island = 0;     ///< whose map frame `points` are in
  std::vector<Vec3> points;   ///< one, or those of a line [m]
  std::vector<Value> values;  ///< one for each field of the layer
};

struct Layer {
  std::string name;
  bool lines = false;  ///< else points
  std::vector<Field> fields;
  std::vector<Feature> features;
};

/// The parameters that say what to write.
struct LayerOptions {
  std::vector<std::string> layers{"tracks", "nodes", "loops", "stems"};
  StemOptions stems;
  void params(ParamVisitor& v);
};

/// The chosen layers that have features, in the order tracks, nodes, loops, stems. Loops between
/// islands are left out: their ends share no frame.
std::vector<Layer> layers_of(const Atlas& atlas, const LayerOptions& options,
                             const Context& context);

/// The layer "stems" without features, and one of them; `id` counts from 1 over all islands.
Layer stem_layer();
Feature stem_feature(const Atlas& atlas, std::size_t id, std::size_t island, const Stem& stem);

/// The names of the missions that saw it, separated by semicolons.
std::string missions_of(const Atlas& atlas, const Stem& stem);

}  // namespace cambium::map_export
