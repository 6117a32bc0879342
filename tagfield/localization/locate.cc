#include "tagfield/localization/locate.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/base/spelling.h"
#include "tagfield/localization/automatic.h"
#include "tagfield/localization/dah.h"
#include "tagfield/localization/hyperbola.h"
#include "tagfield/localization/joint.h"
#include "tagfield/localization/landmarc.h"
#include "tagfield/localization/least_squares.h"
#include "tagfield/localization/maximum_likelihood.h"
#include "tagfield/localization/particle.h"
#include "tagfield/localization/sar.h"
#include "tagfield/localization/trilateration.h"

namespace tagfield {

std::vector<Method> built_in_methods(const MethodSettings& settings) {
  std::vector<Method> methods = {hyperbola_method(settings.hyperbola),
                                 least_squares_method(),
                                 maximum_likelihood_method(),
                                 joint_method(),
                                 sar_method(settings.sar),
                                 dah_method(settings.dah),
                                 particle_method(settings.particle),
                                 trilateration_method(settings.trilateration),
                                 landmarc_method(settings.landmarc)};
  methods.insert(methods.begin(), automatic_method(methods));
  return methods;
}

Method find_method(const std::vector<Method>& methods, const std::string& name) {
  std::vector<std::string> names;
  for (const Method& method : methods) {
    if (method.name == name) return method;
    names.push_back(method.name);
  }
  throw Error(fmt::format("there is no method '{}'{}", name, suggestion(name, names)));
}

LocalizationResult locate_tags(const std::vector<TagRead>& reads,
                               const std::vector<AntennaPose>& poses,
                               const LocalizationOptions& options, Diagnostics& diagnostics) {
  const Method method = find_method(built_in_methods(options.settings), options.method);
  const LocalizationProblem problem = make_problem(reads, poses, options.known, diagnostics);
  return method.locate(problem, options.threads, diagnostics);
}

}  // namespace tagfield
