#include "tagfield/sdf/internal/complaints.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <regex>
#include <set>

namespace tagfield::sdf_internal {
namespace {

/// A complaint about a frame that nobody knows: "ATTRIBUTE name[FRAME] specified by KIND with
/// name[WHO] does not match …".
struct UnknownFrame {
  std::string attribute;
  std::string frame;
  std::string kind;
  std::string who;
};

std::optional<UnknownFrame> unknown_frame(const sdf::Error& error) {
  static const std::regex pattern(
      R"((relative_to|attached_to) name\[([^\]]*)\] specified by (\w+) with name\[([^\]]*)\].*)",
      std::regex::icase);
  const std::string message = plain_words(error);
  std::smatch match;
  // A joint's frames don't matter: joints are not used.
  if (!std::regex_match(message, match, pattern) || match[3] == "joint") return std::nullopt;
  return UnknownFrame{match[1], match[2], match[3], match[4]};
}

bool names_frame(const sdf::ElementPtr& element, const UnknownFrame& unknown) {
  return element && element->HasAttribute(unknown.attribute) &&
         element->Get<std::string>(unknown.attribute) == unknown.frame;
}

/// The element at or below `element` that names the unknown frame; null if none does.
sdf::ElementPtr find_culprit(const sdf::ElementPtr& element, const UnknownFrame& unknown) {
  const bool is_kind = element->GetName() == unknown.kind && element->HasAttribute("name") &&
                       element->Get<std::string>("name") == unknown.who;
  if (is_kind && names_frame(element, unknown)) return element;
  sdf::ElementPtr pose = written_child(element, "pose");
  if (is_kind && names_frame(pose, unknown)) return pose;
  for (auto child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    sdf::ElementPtr culprit = find_culprit(child, unknown);
    if (culprit) return culprit;
  }
  return nullptr;
}

/// Whether a complaint only says that another one was made.
bool is_consequence(const sdf::Error& error) {
  static const std::set<sdf::ErrorCode> graph_codes = {
      sdf::ErrorCode::FRAME_ATTACHED_TO_INVALID,     sdf::ErrorCode::FRAME_ATTACHED_TO_CYCLE,
      sdf::ErrorCode::FRAME_ATTACHED_TO_GRAPH_ERROR, sdf::ErrorCode::POSE_RELATIVE_TO_INVALID,
      sdf::ErrorCode::POSE_RELATIVE_TO_CYCLE,        sdf::ErrorCode::POSE_RELATIVE_TO_GRAPH_ERROR};
  return graph_codes.count(error.Code()) > 0 || error.Message().rfind("Failed to load a", 0) == 0;
}

/// With a name that is reserved or not unique, sdformat may resolve frames wrongly, and say
/// nothing.
bool is_about_names(const sdf::Error& error) {
  return error.Code() == sdf::ErrorCode::RESERVED_NAME ||
         error.Code() == sdf::ErrorCode::DUPLICATE_NAME;
}

std::string why_ignored(sdf::ErrorCode code) {
  switch (code) {
    case sdf::ErrorCode::LINK_INERTIA_INVALID:
      return " (ignored: inertia is not used)";
    case sdf::ErrorCode::JOINT_CHILD_LINK_INVALID:
    case sdf::ErrorCode::JOINT_PARENT_LINK_INVALID:
    case sdf::ErrorCode::JOINT_PARENT_SAME_AS_CHILD:
      return " (ignored: joints are not used)";
    default:
      return " (ignored)";
  }
}

/// sdformat's "a link named link" with the name in quotes; an unknown element in fewer words.
std::string reworded(const sdf::Error& error) {
  static const std::regex unknown_element(
      R"(XML Element\[([^\]]*)\], child of element\[([^\]]*)\], not defined in SDF.*)");
  static const std::regex invalid_inertia(R"(A link named (.*) has invalid inertia.*)");
  std::string message = plain_words(error);
  std::smatch match;
  if (std::regex_match(message, match, unknown_element)) {
    return fmt::format("<{}> in <{}> is not SDF", match[1].str(), match[2].str());
  }
  if (std::regex_match(message, match, invalid_inertia)) {
    return fmt::format("a link named '{}' has invalid inertia", match[1].str());
  }
  return message;
}

}  // namespace

std::string plain_words(std::string message) {
  static const std::regex blanks(R"(\s+)");
  message = std::regex_replace(message, blanks, " ");
  while (!message.empty() && (message.back() == ' ' || message.back() == '.')) message.pop_back();
  return message;
}

std::string plain_words(const sdf::Error& error) { return plain_words(error.Message()); }

Location location_of_error(const Context& context, const sdf::Error& error) {
  return {shown(context, error.FilePath().value_or("")), error.LineNumber().value_or(0)};
}

void require_known_frames(const Context& context, const sdf::Root& root,
                          const sdf::Errors& errors) {
  for (const sdf::Error& error : errors) {
    const auto unknown = unknown_frame(error);
    if (!unknown) continue;
    const sdf::ElementPtr culprit = find_culprit(root.Element(), *unknown);
    fail(culprit ? location_of(context, culprit) : location_of_error(context, error),
         unknown->kind + " '" + unknown->who + "' is " + unknown->attribute + " '" +
             unknown->frame + "', and no such frame is known there");
  }
}

void warn_of(Context& context, const sdf::Errors& errors) {
  const bool all_consequences = std::all_of(errors.begin(), errors.end(), is_consequence);
  for (const sdf::Error& error : errors) {
    if (is_consequence(error) && !all_consequences) continue;
    if (is_about_names(error)) context.frame_trouble = plain_words(error);
    context.diagnostics.warn(location_of_error(context, error),
                             reworded(error) + why_ignored(error.Code()));
  }
}

}  // namespace tagfield::sdf_internal
