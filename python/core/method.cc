// SPDX-License-Identifier: Apache-2.0
#include "python/core/method.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "python/core/arrays.h"
#include "python/core/calls.h"
#include "tagfield/localization/judgement.h"

namespace tagfield::python {
namespace {

/// What a method is given, as long as it runs.
struct ProblemView {
  const LocalizationProblem* problem = nullptr;
  int threads = 1;

  [[nodiscard]] const LocalizationProblem& get() const {
    if (problem == nullptr)
      throw Error("this problem is over: it can only be used while its method runs");
    return *problem;
  }
};

const SamplesOfTag& samples_of(const ProblemView& view, const std::string& tag) {
  const auto found = view.get().samples.find(tag);
  if (found == view.get().samples.end()) throw Error("the problem has no tag '" + tag + "'");
  return found->second;
}

py::object samples_table(const ProblemView& view, const std::string& tag) {
  std::vector<SampleRow> rows;
  Names antennas;
  for (const auto& [antenna, samples] : samples_of(view, tag)) {
    const std::int32_t number = antennas.number_of(antenna);
    for (const PhaseSample& sample : samples) {
      rows.push_back({sample.stamp.time_since_epoch().count(),
                      number,
                      sample.phase_rad,
                      sample.frequency_hz,
                      sample.rssi_dbm,
                      {sample.p_WA.x(), sample.p_WA.y(), sample.p_WA.z()}});
    }
  }
  return table(std::move(rows), {{"antenna", antennas.all()}});
}

using Place = std::tuple<Eigen::Vector3d, std::optional<Eigen::Matrix3d>, double, double>;
using Answer = std::tuple<std::string, std::string, std::vector<Place>>;

/// No passive tag answers over this distance, or a tenth of it; coordinates may be anything.
constexpr double kMaxReach_m = 1000.0;

bool is_in_reach(const SamplesOfTag& samples, const Eigen::Vector3d& place) {
  return std::any_of(samples.begin(), samples.end(), [&](const auto& of_antenna) {
    const std::vector<PhaseSample>& series = of_antenna.second;
    return std::any_of(series.begin(), series.end(), [&](const PhaseSample& sample) {
      return (sample.p_WA - place).norm() <= kMaxReach_m;
    });
  });
}

TagEstimate estimate_of(const LocalizationProblem& problem, const Answer& answer,
                        std::vector<std::string>& out_of_reach) {
  const auto& [tag, why, places] = answer;
  const SamplesOfTag& samples = problem.samples.at(tag);
  TagEstimate estimate = begun(tag, samples);
  if (places.empty()) return not_located(estimate, why);
  for (const auto& [place, covariance, expected_error_m, rms_m] : places) {
    if (!is_in_reach(samples, place)) continue;
    estimate.candidates.push_back({place, rms_m, expected_error_m, covariance});
  }
  if (estimate.candidates.size() < places.size()) out_of_reach.push_back(tag);
  if (estimate.candidates.empty()) {
    return not_located(
        estimate, fmt::format("its position is over {:g} m from where it was read", kMaxReach_m));
  }
  judge(problem.limits, estimate);
  return estimate;
}

void warn_of(const std::string& method, const std::vector<std::string>& out_of_reach,
             Diagnostics& diagnostics) {
  if (out_of_reach.empty()) return;
  diagnostics.warn(
      fmt::format("method '{}': positions over {:g} m from where a tag was read are left out, of "
                  "{} tag{}: {}{}",
                  method, kMaxReach_m, out_of_reach.size(), out_of_reach.size() == 1 ? "" : "s",
                  out_of_reach.front(), out_of_reach.size() == 1 ? "" : ", …"));
}

/// The answers of a method that was called with Python's lock held.
std::vector<Answer> ask(const Held& function, const LocalizationProblem& problem, int threads) {
  const py::gil_scoped_acquire lock;
  const auto view = std::make_shared<ProblemView>(ProblemView{&problem, threads});
  struct End {
    ProblemView& view;
    ~End() { view.problem = nullptr; }
  } const end{*view};
  return py::cast<std::vector<Answer>>((*function)(view));
}

LocalizationResult locate(const std::string& name, const Held& function,
                          const LocalizationProblem& problem, int threads,
                          Diagnostics& diagnostics) {
  std::map<std::string, TagEstimate> by_tag;
  std::vector<std::string> out_of_reach;
  for (const Answer& answer : ask(function, problem, threads)) {
    by_tag[std::get<0>(answer)] = estimate_of(problem, answer, out_of_reach);
  }
  warn_of(name, out_of_reach, diagnostics);
  LocalizationResult result;
  result.method = name;
  for (const auto& [tag, samples] : problem.samples) {
    const auto reference = problem.reference_tags.find(tag);
    result.estimates.push_back(reference == problem.reference_tags.end()
                                   ? std::move(by_tag.at(tag))
                                   : reference_estimate(tag, reference->second));
  }
  return result;
}

Method method_of(const std::string& name, const std::string& summary, py::object function) {
  const Held kept = held(std::move(function));
  Method method;
  method.name = name;
  method.summary = summary;
  method.locate = [name, kept](const LocalizationProblem& problem, int threads,
                               Diagnostics& diagnostics) {
    return locate(name, kept, problem, threads, diagnostics);
  };
  return method;
}

}  // namespace

void bind_methods(py::module_& module) {
  py::class_<ProblemView, std::shared_ptr<ProblemView>>(
      module, "Problem",
      "What a localization method is given: reads joined with the antennas' believed positions, "
      "and\n"
      "what is known beforehand. Nothing about where the tags are. Valid while the method runs.")
      .def_property_readonly(
          "tags",
          [](const ProblemView& view) {
            std::vector<std::string> tags;
            for (const auto& [tag, samples] : view.get().samples) tags.push_back(tag);
            return tags;
          },
          "IDs of the tags that were read, in rising order.")
      .def("samples", &samples_table, py::arg("tag"),
           "Table of a tag's reads: stamp_ns, antenna, phase_rad in [0, 2π), frequency_hz,\n"
           "rssi_dbm and position_m (3,) [m, world] of the antenna as believed; by antenna, then\n"
           "in order of time.")
      .def(
          "height_m",
          [](const ProblemView& view, const std::string& tag) {
            samples_of(view, tag);
            return plane_height(view.get(), tag);
          },
          py::arg("tag"), "Height of the tag [m, world]: known, or else the antennas' mean.")
      .def_property_readonly(
          "reference_tags", [](const ProblemView& view) { return view.get().reference_tags; },
          "Positions (3,) [m, world] of tags at known positions, by ID.")
      .def_property_readonly(
          "pi_ambiguity", [](const ProblemView& view) { return view.get().pi_ambiguity; },
          "Whether phases have the π ambiguity: then phases and carriers of samples are doubled.")
      .def_property_readonly(
          "has_phases", [](const ProblemView& view) { return view.get().has_phases; },
          "False where the reads have none.")
      .def(
          "_report", [](const ProblemView& view, double share) { tell(view.get(), "tags", share); },
          py::arg("share"), "Reports the share of tags that are done, which may end the method.")
      .def_property_readonly(
          "threads", [](const ProblemView& view) { return view.threads; },
          "On how many threads the method may work.");
  py::class_<Method>(module, "Method",
                     "A localization method of your own, as tagfield.method() makes one.")
      .def(py::init(&method_of), py::arg("name"), py::arg("summary"), py::arg("function"))
      .def_readonly("name", &Method::name, "Its name in tables.")
      .def_readonly("summary", &Method::summary, "A one-line description.");
}

}  // namespace tagfield::python
