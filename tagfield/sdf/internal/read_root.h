/// @file
/// An SDF file to sdformat's own tree.
#pragma once

#include <sdf/Root.hh>
#include <string>

#include "tagfield/sdf/internal/context.h"

namespace tagfield::sdf_internal {

/// Reads `context.absolute_path`. Complaints that leave the geometry whole go to the context's
/// diagnostics. Throws Error for a file that is missing or malformed, an include that can't be
/// found and a frame that nobody knows.
/// For the whole process: quiets sdformat's console for good (each of its messages comes as an
/// error object as well) and std::cerr while sdformat reads; loads in several threads take turns.
sdf::Root read_root(Context& context);

/// Throws Error if sdformat dropped some of the children `name` of `parent` (it keeps the first of
/// two with one name), that is, if it holds fewer than the file.
void require_all_read(const Context& context, const sdf::ElementPtr& parent,
                      const std::string& name, std::size_t count);

}  // namespace tagfield::sdf_internal
