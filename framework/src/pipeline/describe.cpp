// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/describe.hpp"

#include <fmt/format.h>

#include "pipeline/binder.hpp"
#include "pipeline/params.hpp"

namespace cambium {

std::string describe_markdown(const Registered& c) {
  std::string out = fmt::format("## {}\n\n{}. A {} of the plugin `{}` {}.\n\n", c.name, c.summary,
                                to_string(c.kind), c.plugin, c.plugin_version);
  const auto component = c.create();
  const auto params = list_params(*component);
  if (params.empty()) return out + "It has no parameters.\n\n";
  std::string more;
  out += "| parameter | default | allowed | meaning |\n|---|---|---|---|\n";
  for (const auto& p : params) {
    const std::string allowed = to_text(p.constraint);
    std::string value = p.value.dump();
    if (!p.constraint.unit.empty() && !is_file(p.constraint)) value += " " + p.constraint.unit;
    out += fmt::format("| `{}` | {} | {} | {} |\n", p.name, value,
                       allowed.empty() ? p.type : allowed, p.doc);
    if (declares_more(p.constraint))
      more += fmt::format("\nThe file that `{}` names declares further parameters.\n", p.name);
  }
  return out + more + "\n";
}

std::string reference_markdown(const Registry& registry) {
  std::string out =
      "# Plugin reference\n\nMade by `cambium plugins describe`; each plugin's own README says when to "
      "use it.\n";
  std::string kind;
  for (const auto& [key, component] : registry.all()) {
    if (kind != to_string(component.kind)) {
      kind = to_string(component.kind);
      out += fmt::format("\n# {}\n\n", kind);
    }
    out += describe_markdown(component);
  }
  out.pop_back();  // one newline at the end
  return out;
}

}  // namespace cambium
