// The files of two runs, compared bit by bit.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "host/output/hdf5_handles.hpp"
#include "temp_folder.hpp"

namespace slagflow::testing_tools {

using Tables = std::map<std::string, std::vector<double>>;

// Every data set below a group; a double holds each of their types exactly.
inline void read_tables(const hdf5::File& file, const std::string& group, Tables& tables) {
  for (const std::string& name : members(file, group)) {
    const std::string path = group + "/" + name;
    H5O_info_t info{};
    file.check(H5Oget_info_by_name2(file.id(), path.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT), "read");
    if (info.type == H5O_TYPE_GROUP) {
      read_tables(file, path, tables);
      continue;
    }
    const hdf5::Handle table = open_dataset(file, path);
    std::vector<double>& values = tables[path];
    values.resize(rows(file, table) * columns(file, table));
    read_rows(file, table, {0, rows(file, table)}, H5T_NATIVE_DOUBLE, values.data());
  }
}

inline Tables tables_of(const std::string& path) {
  const hdf5::File file = hdf5::File::open(path, hdf5::File::Access::read);
  Tables tables;
  read_tables(file, "/VTKHDF", tables);
  tables["steps"] = {static_cast<double>(read_integer(file, open_group(file, "/VTKHDF/Steps"), "NSteps"))};
  return tables;
}

inline std::string measures_of(const std::string& folder) {
  const std::string summary = read_text_file(folder + "/summary.json");
  return summary.substr(summary.find("\"measures\""));
}

inline void expect_same_results(const std::string& folder, const std::string& unbroken) {
  EXPECT_EQ(read_text_file(folder + "/history.csv"), read_text_file(unbroken + "/history.csv"));
  EXPECT_EQ(read_text_file(folder + "/profile_height.csv"), read_text_file(unbroken + "/profile_height.csv"));
  EXPECT_EQ(measures_of(folder), measures_of(unbroken));
  EXPECT_THAT(read_text_file(folder + "/summary.json"), testing::HasSubstr("\"status\": \"done\""));
  for (const char* name : {"/particles.vtkhdf", "/walls.vtkhdf"}) {
    const Tables one = tables_of(folder + name), other = tables_of(unbroken + name);
    ASSERT_EQ(one.size(), other.size());
    for (const auto& [path, values] : one)
      EXPECT_TRUE(other.count(path) > 0 && values == other.at(path)) << name << " " << path;
  }
}

}  // namespace slagflow::testing_tools
