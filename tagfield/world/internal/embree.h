// SPDX-License-Identifier: Apache-2.0
/// @file
/// One interface to Embree 3 and 4, covering the calls that differ. CMake selects the version with
/// TAGFIELD_EMBREE.
#pragma once

#if TAGFIELD_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace tagfield::embree {

/// Whether rays that are traced together have similar directions.
enum class Coherence { kIncoherent, kCoherent };

using Context =
#if TAGFIELD_EMBREE >= 4
    RTCRayQueryContext;
#else
    RTCIntersectContext;
#endif

#if TAGFIELD_EMBREE >= 4

inline void init(Context& context) { rtcInitRayQueryContext(&context); }

inline RTCIntersectArguments intersect_arguments(Context& context, Coherence coherence) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  arguments.flags = coherence == Coherence::kCoherent ? RTC_RAY_QUERY_FLAG_COHERENT
                                                      : RTC_RAY_QUERY_FLAG_INCOHERENT;
  return arguments;
}

inline void intersect(RTCScene scene, Context& context, RTCRayHit& hit) {
  RTCIntersectArguments arguments = intersect_arguments(context, Coherence::kIncoherent);
  rtcIntersect1(scene, &hit, &arguments);
}

inline void intersect(const int* valid, RTCScene scene, Context& context, Coherence coherence,
                      RTCRayHit16& hits) {
  RTCIntersectArguments arguments = intersect_arguments(context, coherence);
  rtcIntersect16(valid, scene, &hits, &arguments);
}

inline void occluded(RTCScene scene, Context& context, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}

#else

inline void init(Context& context) { rtcInitIntersectContext(&context); }

inline void intersect(RTCScene scene, Context& context, RTCRayHit& hit) {
  rtcIntersect1(scene, &context, &hit);
}

inline void intersect(const int* valid, RTCScene scene, Context& context, Coherence coherence,
                      RTCRayHit16& hits) {
  if (coherence == Coherence::kCoherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &hits);
}

inline void occluded(RTCScene scene, Context& context, RTCRay& ray) {
  rtcOccluded1(scene, &context, &ray);
}

#endif

}  // namespace tagfield::embree
