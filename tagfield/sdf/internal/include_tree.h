/// @file
/// The <include>s of a world, found by reading its files before sdformat does: it drops what it
/// can't make out of a file that another file includes, and says so on its console only.
#pragma once

#include <cstddef>
#include <map>
#include <sdf/Element.hh>
#include <string>
#include <vector>

#include "tagfield/sdf/internal/context.h"

namespace tagfield::sdf_internal {

struct Include {
  std::string uri;
  Location location;
  std::string file;        ///< The model file that it names, "" if there is none.
  bool is_merged = false;  ///< Its parts go into the model around it.
};

/// The files that a world is made of.
struct IncludeTree {
  std::map<std::string, std::vector<Include>> includes;  ///< By the file that they stand in.
  std::map<std::string, std::string>
      file_of;  ///< What the URIs name. Nobody knows which file asks.
};

/// Reads `context.absolute_path` and all that it includes. Throws Error for a file that is not XML,
/// files that can't be found (all in one message), one that includes itself, a relative URI that
/// names two different files, and for more than kMostIncludes models.
IncludeTree include_tree(Context& context);

/// More would fill the memory: sdformat takes about 2.5 MB a model.
constexpr std::size_t kMostIncludes = 20'000;

/// Throws Error if `root`, read from these files, has fewer included models than they ask for.
void require_all_included(const Context& context, const IncludeTree& tree,
                          const sdf::ElementPtr& root);

}  // namespace tagfield::sdf_internal
