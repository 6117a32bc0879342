// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/xml_outline.h"

#include <algorithm>
#include <string_view>

namespace tagfield::sdf_internal {
namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  XmlOutline run() {
    while (result_.error.empty() && go_to_next_tag()) {
      const bool skipped =
          skip("<!--", "-->") || skip("<![CDATA[", "]]>") || skip("<?", "?>") || skip("<!", ">");
      if (!skipped) read_tag();
    }
    if (result_.error.empty() && !open_.empty()) {
      report("<" + open_.back().name + "> is never closed", open_.back().line);
    }
    return result_;
  }

 private:
  bool go_to_next_tag() {
    const std::size_t next = text_.find('<', at_);
    advance_to(std::min(next, text_.size()));
    return next != std::string_view::npos;
  }

  void advance_to(std::size_t position) {
    const std::string_view passed = text_.substr(at_, position - at_);
    line_ += static_cast<int>(std::count(passed.begin(), passed.end(), '\n'));
    at_ = position;
  }

  void report(const std::string& error, int line) {
    result_.error = error;
    result_.error_line = line;
  }

  bool skip(std::string_view begin, std::string_view end) {
    if (text_.substr(at_, begin.size()) != begin) return false;
    const std::size_t found = text_.find(end, at_ + begin.size());
    if (found == std::string_view::npos) {
      report(std::string(begin) + " is never closed", line_);
    } else {
      advance_to(found + end.size());
    }
    return true;
  }

  /// The position of the '>' that ends this tag, ignoring those in quotes.
  [[nodiscard]] std::size_t tag_end() const {
    char quote = '\0';
    for (std::size_t i = at_ + 1; i < text_.size(); ++i) {
      const char c = text_[i];
      if (quote != '\0') {
        if (c == quote) quote = '\0';
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '>') {
        return i;
      }
    }
    return std::string_view::npos;
  }

  void read_tag() {
    const std::size_t end = tag_end();
    if (end == std::string_view::npos) return report("a tag is never ended", line_);
    const std::string_view inside = text_.substr(at_ + 1, end - at_ - 1);
    if (!inside.empty() && inside.front() == '/') {
      close(name_in(inside.substr(1)));
    } else {
      open(name_in(inside), !inside.empty() && inside.back() == '/');
    }
    advance_to(end + 1);
  }

  static std::string name_in(std::string_view inside) {
    return std::string(inside.substr(0, inside.find_first_of(" \t\r\n/")));
  }

  void open(const std::string& name, bool closes_itself) {
    if (name.empty()) return report("'<' without a name", line_);
    const XmlTag tag{name, line_, static_cast<int>(open_.size())};
    result_.tags.push_back(tag);
    if (!closes_itself) open_.push_back(tag);
  }

  void close(const std::string& name) {
    if (open_.empty()) return report("</" + name + "> closes nothing", line_);
    const XmlTag& last = open_.back();
    if (last.name != name) {
      return report("</" + name + "> where </" + last.name + "> was expected (<" + last.name +
                        "> is on line " + std::to_string(last.line) + ")",
                    line_);
    }
    open_.pop_back();
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::vector<XmlTag> open_;
  XmlOutline result_;
};

}  // namespace

XmlOutline outline_xml(const std::string& text) { return Scanner(text).run(); }

}  // namespace tagfield::sdf_internal
