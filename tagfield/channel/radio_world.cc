// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/radio_world.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <set>

namespace tagfield {
namespace {

/// Whether `text` matches `pattern`, in which * stands for any characters.
bool fits(std::string_view pattern, std::string_view text) {
  std::size_t p = 0;
  std::size_t t = 0;
  std::size_t star = std::string_view::npos;
  std::size_t resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

/// A scoped name and its enclosing scopes: "a::b::c", "a::b", "a".
std::vector<std::string> scopes_of(const std::string& name) {
  std::vector<std::string> scopes = {name};
  for (std::size_t end = name.rfind("::"); end != std::string::npos && end > 0;
       end = name.rfind("::", end - 1)) {
    scopes.push_back(name.substr(0, end));
  }
  return scopes;
}

bool applies(const MaterialRule& rule, const Collision& collision) {
  std::vector<std::string> names = scopes_of(collision.name);
  names.insert(names.end(), collision.looks.begin(), collision.looks.end());
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return fits(rule.name, name); });
}

struct Hint {
  const char* word;  ///< Of a name, in lower case; two adjacent words also count as one.
  const char* material;
};

/// Hints on materials from common names of objects in halls. The first match counts.
constexpr std::array<Hint, 40> kHints = {{
    {"cardboard", "cardboard"},
    {"carton", "cardboard"},
    {"plaster", "plasterboard"},
    {"plasterboard", "plasterboard"},
    {"drywall", "plasterboard"},
    {"plywood", "plywood"},
    {"chipboard", "chipboard"},
    {"brick", "brick"},
    {"concrete", "concrete"},
    {"marble", "marble"},
    {"glass", "glass"},
    {"window", "glass"},
    {"ceiling", "ceiling_board"},
    {"metal", "metal"},
    {"metallic", "metal"},
    {"steel", "metal"},
    {"iron", "metal"},
    {"aluminium", "metal"},
    {"aluminum", "metal"},
    {"palletjack", "metal"},
    {"rack", "metal"},
    {"racking", "metal"},
    {"bookshelf", "wood"},
    {"shelf", "metal"},
    {"shelve", "metal"},
    {"shelving", "metal"},
    {"forklift", "metal"},
    {"container", "metal"},
    {"trashcan", "metal"},
    {"lamp", "metal"},
    {"wood", "wood"},
    {"wooden", "wood"},
    {"pallet", "wood"},
    {"crate", "wood"},
    {"desk", "wood"},
    {"table", "wood"},
    {"box", "cardboard"},
    {"clutter", "cardboard"},
    {"cluttering", "cardboard"},
    {"wall", "concrete"},
}};

/// The words of a name, in lower case: of "oldIRONShelf-2b" old, iron, shelf, b.
std::vector<std::string> words_of(std::string_view name) {
  const auto is = [](int (*kind)(int), char c) { return kind(static_cast<unsigned char>(c)) != 0; };
  std::vector<std::string> words;
  char before = ' ';
  for (std::size_t i = 0; i < name.size(); before = name[i++]) {
    if (!is(std::isalpha, name[i])) continue;
    const bool ends_capitals = i + 1 < name.size() && is(std::islower, name[i + 1]);
    const bool begins = is(std::isupper, name[i]) && (is(std::islower, before) || ends_capitals);
    if (begins || !is(std::isalpha, before)) words.emplace_back();
    words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  }
  return words;
}

/// Whether `text` is the word or its plural.
bool is_word(std::string_view text, std::string_view word) {
  if (text.substr(0, word.size()) != word) return false;
  const std::string_view end = text.substr(word.size());
  return end.empty() || end == "s" || end == "es";
}

bool has_word(const std::vector<std::string>& words, std::string_view word) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (is_word(words[i], word)) return true;
    if (i > 0 && is_word(words[i - 1] + words[i], word)) return true;
  }
  return false;
}

/// From the innermost part of the name outwards, since a rack may hold boxes; none without a hint.
std::optional<std::string> guess(const Collision& collision) {
  for (const std::string& scope : scopes_of(collision.name)) {
    const std::size_t begin = scope.rfind("::");
    const std::vector<std::string> words =
        words_of(begin == std::string::npos ? scope : scope.substr(begin + 2));
    for (const Hint& hint : kHints) {
      if (has_word(words, hint.word)) return hint.material;
    }
  }
  return std::nullopt;
}

std::string model_of(const std::string& name) { return name.substr(0, name.find("::")); }

/// The guesses: models by material.
using Guesses = std::map<std::string, std::set<std::string>>;

void warn_of_guesses(const Guesses& guesses, Diagnostics& diagnostics) {
  if (guesses.empty()) return;
  std::vector<std::string> parts;
  for (const auto& [material, models] : guesses) {
    constexpr std::size_t kNamed = 3;
    std::vector<std::string> named(
        models.begin(),
        std::next(models.begin(), static_cast<std::ptrdiff_t>(std::min(kNamed, models.size()))));
    const std::size_t others = models.size() - named.size();
    parts.push_back(fmt::format("{} for {}{}", material, fmt::join(named, ", "),
                                others > 0 ? fmt::format(" and {} more", others) : ""));
  }
  diagnostics.warn(
      fmt::format("materials are guessed from names: {} (state them under world.materials)",
                  fmt::join(parts, "; ")));
}

void warn_of_idle_rules(const std::vector<MaterialRule>& rules, const Scene& scene,
                        Diagnostics& diagnostics) {
  for (const MaterialRule& rule : rules) {
    const bool fits_any =
        std::any_of(scene.collisions.begin(), scene.collisions.end(),
                    [&](const Collision& collision) { return applies(rule, collision); });
    if (fits_any) continue;
    diagnostics.warn(rule.location, fmt::format("no solid part of the world is called '{}'; '{}' "
                                                "is not used there",
                                                rule.name, rule.material.name));
  }
}

std::vector<Material> materials_for(const Scene& scene, const RadioWorldOptions& options,
                                    Diagnostics& diagnostics) {
  std::vector<Material> of_solid;
  Guesses guesses;
  for (const Collision& collision : scene.collisions) {
    const auto rule = std::find_if(options.rules.rbegin(), options.rules.rend(),
                                   [&](const MaterialRule& r) { return applies(r, collision); });
    if (rule != options.rules.rend()) {
      of_solid.push_back(rule->material);
      continue;
    }
    const std::optional<std::string> hint = guess(collision);
    of_solid.push_back(find_material(options.materials, hint.value_or(options.otherwise)));
    if (!hint && options.states_otherwise) continue;
    guesses[of_solid.back().name].insert(model_of(collision.name));
  }
  warn_of_guesses(guesses, diagnostics);
  warn_of_idle_rules(options.rules, scene, diagnostics);
  return of_solid;
}

/// Adds the material if it is new.
std::uint32_t index_of(const Material& material, std::vector<Material>& materials) {
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (materials[i].name == material.name) return static_cast<std::uint32_t>(i);
  }
  materials.push_back(material);
  return static_cast<std::uint32_t>(materials.size() - 1);
}

RadioScene make_scene(const Scene& scene, const std::vector<Material>& of_solid,
                      double min_facet_m2) {
  RadioSceneOptions options;
  options.min_facet_m2 = min_facet_m2;
  for (const Material& material : of_solid) {
    options.opaque.push_back(static_cast<char>(material.is_opaque));
  }
  return RadioScene(scene, options);
}

}  // namespace

const std::vector<DiffractingEdge>& EdgesOnDemand::of(const RadioScene& waves) const {
  std::call_once(once_, [&] { edges_ = diffracting_edges(scene_, waves); });
  return edges_;
}

RadioWorld radio_world(const Scene& scene, const RadioWorldOptions& options,
                       Diagnostics& diagnostics) {
  const std::vector<Material> of_solid = materials_for(scene, options, diagnostics);
  RadioWorld world{make_scene(scene, of_solid, options.min_facet_m2),
                   {},
                   {},
                   {},
                   std::make_shared<const EdgesOnDemand>(scene)};
  for (std::size_t i = 0; i < of_solid.size(); ++i) {
    world.material_of.push_back(index_of(of_solid[i], world.materials));
    world.solids.push_back(scene.collisions[i].name);
  }
  return world;
}

std::vector<std::complex<double>> permittivities(const RadioWorld& world, double frequency_hz) {
  std::vector<std::complex<double>> all;
  for (const Material& material : world.materials) {
    all.push_back(permittivity(material, frequency_hz));
  }
  return all;
}

}  // namespace tagfield
