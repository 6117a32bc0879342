/// @file
/// Nearest reference tags in signal space, after Ni et al., "LANDMARC: indoor location sensing
/// using active RFID", PerCom 2003, doi 10.1109/PERCOM.2003.1192765. docs/methods.md.
#pragma once

#include "tagfield/localization/method.h"
#include "tagfield/localization/method_settings.h"

namespace tagfield {

/// "landmarc": all tags, one by one. Throws Error on options out of their range.
Method landmarc_method(const LandmarcOptions& options);

}  // namespace tagfield
