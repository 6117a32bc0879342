#include "tagfield/localization/locate.h"

#include "tagfield/localization/automatic.h"
#include "tagfield/localization/holograms/dah.h"
#include "tagfield/localization/holograms/particle.h"
#include "tagfield/localization/holograms/sar.h"
#include "tagfield/localization/joint/joint.h"
#include "tagfield/localization/phase_curves/hyperbola.h"
#include "tagfield/localization/phase_curves/least_squares.h"
#include "tagfield/localization/phase_curves/maximum_likelihood.h"
#include "tagfield/localization/signal_strength/landmarc.h"
#include "tagfield/localization/signal_strength/trilateration.h"

namespace tagfield {

std::vector<Method> built_in_methods() {
  std::vector<Method> methods = {
      hyperbola_method(), least_squares_method(), maximum_likelihood_method(),
      joint_method(),     sar_method(),           dah_method(),
      particle_method(),  trilateration_method(), landmarc_method(),
  };
  methods.insert(methods.begin(), automatic_method(methods));
  return methods;
}

LocalizationResult locate_tags(const std::vector<TagRead>& reads,
                               const std::vector<AntennaPose>& poses,
                               const LocalizationOptions& options, Diagnostics& diagnostics) {
  const Method method = configured(find_method(options.methods, options.method), options.settings);
  const LocalizationProblem problem = make_problem(reads, poses, options.known, diagnostics);
  return method.locate(problem, options.threads, diagnostics);
}

}  // namespace tagfield
