// In place of mcap_sweep.cc, in builds without MCAP.
#include "adapters/ros1/mcap_sweep.h"

namespace tagfield {

BagContent sweep_mcap(const std::string& path,
                      const std::function<void(double share)>& /*on_progress*/,
                      Diagnostics& /*diagnostics*/) {
  fail({path, 0}, "is MCAP, and this tagfield was built without it (liblz4 and libzstd)");
}

}  // namespace tagfield
