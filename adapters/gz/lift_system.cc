// SPDX-License-Identifier: Apache-2.0
// libtagfield-gz.so, tagfield::systems::Lift: moves a prismatic joint and what it carries up and
// down. In <model>:
//
//     <plugin filename="tagfield-gz" name="tagfield::systems::Lift">
//       <joint>mast_joint</joint> <speed>0.35</speed> <lower>0</lower> <upper>1</upper>
//     </plugin>
//
// Units and defaults: LiftParameters in tagfield/motion/robot_parameters.h.
#define TAGFIELD_NEXT_SYSTEM
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <sdf/Element.hh>

#include "adapters/gazebo_common/sdf_elements.h"
#include "adapters/gz/entities.h"
#include "tagfield/base/error.h"
#include "tagfield/motion/robot_parameters.h"

namespace tagfield::systems {

class Lift final : public gz_sim::System,
                   public gz_sim::ISystemConfigure,
                   public gz_sim::ISystemPreUpdate {
 public:
  void Configure(const gz_sim::Entity& model, const std::shared_ptr<const sdf::Element>& sdf,
                 gz_sim::EntityComponentManager& ecm, gz_sim::EventManager& /*events*/) override {
    const std::string place = fmt::format("model '{}', plugin 'Lift'", name_of(model, ecm));
    try {
      Diagnostics diagnostics;
      parameters_ = lift_from(parameters_in(sdf->Clone()), diagnostics);
      for (const std::string& warning : diagnostics.warnings()) {
        report_warning(fmt::format("{}: {}", place, warning));
      }
      joint_ = find_joint(model, ecm);
    } catch (const Error& error) {
      tell_error(fmt::format("{}: {}; stands still", place, error.what()));
      parameters_.reset();
    }
  }

  void PreUpdate(const gz_sim::UpdateInfo& info, gz_sim::EntityComponentManager& ecm) override {
    if (!parameters_ || info.paused) return;
    const double height = parameters_->lower_m + lift_height(parameters_->lift, Time(info.simTime));
    ecm.SetComponentData<gz_sim::components::JointPositionReset>(joint_, {height});
  }

 private:
  gz_sim::Entity find_joint(gz_sim::Entity model, const gz_sim::EntityComponentManager& ecm) const {
    const gz_sim::Entity found = ecm.EntityByComponents(
        gz_sim::components::ParentEntity(model), gz_sim::components::Name(parameters_->joint),
        gz_sim::components::Joint());
    if (found != gz_sim::kNullEntity) return found;
    throw Error(fmt::format("<joint> is '{}', expected a joint of the model", parameters_->joint));
  }

  std::optional<LiftParameters> parameters_;
  gz_sim::Entity joint_ = gz_sim::kNullEntity;
};

}  // namespace tagfield::systems

TAGFIELD_ADD_SYSTEM(tagfield::systems::Lift, tagfield::systems::Lift::ISystemConfigure,
                    tagfield::systems::Lift::ISystemPreUpdate)
