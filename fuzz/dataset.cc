// SPDX-License-Identifier: Apache-2.0
// Third-party tables: a table's format as YAML, a NUL, the table.
#include "fuzz/input.h"
#include "tagfield/files/dataset_csv.h"
#include "tagfield/scenario/dataset_format.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tagfield;
  const std::string_view text = fuzz::text_of(data, size);
  const std::size_t zero = text.find('\0');
  if (zero == std::string_view::npos) return 0;
  const std::string form_path = fuzz::folder().write("form.yaml", text.substr(0, zero));
  const std::string table = fuzz::folder().write("table.csv", text.substr(zero + 1));
  return fuzz::refused_or_taken([&] {
    const DatasetForm form = read_dataset_form(form_path);
    if (form.poses) read_dataset_poses_csv(table, *form.poses);
    read_dataset_csv(table, form);
  });
}
