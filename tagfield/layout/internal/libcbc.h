// SPDX-License-Identifier: Apache-2.0
/// @file
/// CBC, loaded when an exact plan is requested.
#pragma once

#include <coin/Cbc_C_Interface.h>

#include "tagfield/base/loaded_library.h"

namespace tagfield {

/// Its functions, by their names without "Cbc_".
struct LibCbc : LoadedLibrary {
  LibCbc() : LoadedLibrary("Exact plans", TAGFIELD_LIBCBC) {}
  decltype(&Cbc_deleteModel) deleteModel = function("Cbc_deleteModel");
  decltype(&Cbc_getBestPossibleObjValue) getBestPossibleObjValue =
      function("Cbc_getBestPossibleObjValue");
  decltype(&Cbc_getColSolution) getColSolution = function("Cbc_getColSolution");
  decltype(&Cbc_isProvenInfeasible) isProvenInfeasible = function("Cbc_isProvenInfeasible");
  decltype(&Cbc_isProvenOptimal) isProvenOptimal = function("Cbc_isProvenOptimal");
  decltype(&Cbc_loadProblem) loadProblem = function("Cbc_loadProblem");
  decltype(&Cbc_newModel) newModel = function("Cbc_newModel");
  decltype(&Cbc_setInteger) setInteger = function("Cbc_setInteger");
  decltype(&Cbc_setParameter) setParameter = function("Cbc_setParameter");
  decltype(&Cbc_solve) solve = function("Cbc_solve");
};

inline const LibCbc& libcbc() { return loaded<LibCbc>(); }

}  // namespace tagfield
