#include "tests/architecture/include_rules.hpp"

#include <gtest/gtest.h>

#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

std::vector<std::string> faults_of(const TempFolder& tree) {
  return include_faults(tree.path(), include_rules());
}

TEST(Architecture, RepositoryFollowsIncludeRules) {
  std::string all;
  for (const std::string& fault : include_faults(MMS_SOURCE_DIR, include_rules()))
    all += fault + "\n";
  EXPECT_TRUE(all.empty()) << all;
}

TEST(Architecture, RulesNameExistingFolders) {
  const std::filesystem::path root = MMS_SOURCE_DIR;
  const std::set<std::string> beside_mms = {"apps", "interfaces", "benchmarks", "examples",
                                            "tests"};
  for (const auto& [module, targets] : include_rules().modules) {
    const auto folder = beside_mms.contains(module) ? root / module : root / "mms" / module;
    EXPECT_TRUE(std::filesystem::is_directory(folder)) << module << " is gone";
    for (const std::string& target : targets) {
      EXPECT_TRUE(include_rules().modules.contains(target)) << target;
    }
  }
  for (const auto& [module, folders] : include_rules().folders) {
    const auto base = module == "apps" ? root / "apps/mms" : root / "mms" / module;
    for (const std::string& folder : folders) {
      EXPECT_TRUE(std::filesystem::is_directory(base / folder)) << module << " " << folder;
    }
  }
}

TEST(Architecture, PaperModulesDoNotIncludeEachOther) {
  const std::set<std::string> paper = {"segmentation", "fusion", "localization", "mapping"};
  for (const std::string& from : paper) {
    for (const std::string& to : paper) EXPECT_FALSE(include_rules().modules.at(from).contains(to));
  }
}

TEST(Architecture, RejectsIncludeFromFusionToMapping) {
  const TempFolder tree;
  tree.write("mms/mapping/static_map/static_map.hpp",
             "#pragma once\n#include \"mms/core/frame.hpp\"\n");
  tree.write("mms/fusion/fusion.cpp",
             "#include \"mms/fusion/fusion.hpp\"\n\n#include \"mms/core/frame.hpp\"\n"
             "#include \"mms/mapping/static_map/static_map.hpp\"\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0],
            "mms/fusion/fusion.cpp:4: includes \"mms/mapping/static_map/static_map.hpp\": arrow "
            "fusion -> "
            "mapping is forbidden, allowed: core, geometry");
}

TEST(Architecture, RejectsIncludesInCore) {
  const TempFolder tree;
  tree.write("mms/core/frame.cpp", "#include \"mms/geometry/se3.hpp\"\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 1U);
  expect_in("arrow core -> geometry is forbidden, allowed: none", faults[0]);
}

TEST(Architecture, RejectsIncludesNotFromRoot) {
  const TempFolder tree;
  tree.write("mms/fusion/a.cpp", "#include \"../mapping/static_map.hpp\"\n");
  tree.write("mms/fusion/b.cpp", "#  include <mms/mapping/static_map/static_map.hpp>\n");
  tree.write("mms/fusion/c.cpp", "#include \"mms/fusion/../mapping/static_map.hpp\"\n");
  tree.write("mms/fusion/d.cpp", "#include \"fusion.hpp\"\n");
  tree.write("mms/fusion/e.cpp", "#include <vector>\n// #include \"mms/mapping/x.hpp\"\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 4U);
  expect_in("a.cpp:1: includes \"../mapping/static_map.hpp\", allowed: \"mms/", faults[0]);
  expect_in("b.cpp:1: includes <mms/mapping/static_map/static_map.hpp>, project headers",
            faults[1]);
  expect_in("c.cpp:1: includes \"mms/fusion/../mapping", faults[2]);
  expect_in("d.cpp:1: includes \"fusion.hpp\"", faults[3]);
}

TEST(Architecture, RejectsHeaderWithoutGuard) {
  const TempFolder tree;
  tree.write("mms/core/bare.hpp", "int x();\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 1U);
  expect_in("mms/core/bare.hpp:1: a header without #pragma once", faults[0]);
}

TEST(Architecture, RejectsModuleWithoutRules) {
  const TempFolder tree;
  tree.write("mms/helpers/help.hpp", "#pragma once\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 1U);
  expect_in("module 'helpers' has no rules", faults[0]);
}

TEST(Architecture, RejectsIncludeOfHigherFolder) {
  const TempFolder tree;
  tree.write("mms/fusion/clouds/a.cpp", "#include \"mms/fusion/masks/b.hpp\"\n");
  tree.write("mms/fusion/masks/b.hpp", "#pragma once\n#include \"mms/fusion/clouds/c.hpp\"\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 1U);
  expect_in("clouds/a.cpp:1: includes \"mms/fusion/masks/b.hpp\": folder 'masks' lies above",
            faults[0]);
}

TEST(Architecture, RejectsUnknownFolder) {
  const TempFolder tree;
  tree.write("mms/fusion/odds/a.hpp", "#pragma once\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 1U);
  expect_in("folder 'odds' of module 'fusion' has no place", faults[0]);
}

TEST(Architecture, RejectsProgramSourcesInLibrary) {
  const TempFolder tree;
  tree.write("interfaces/ros1/src/node.cpp", "#include \"apps/mms/console/progress.hpp\"\n");
  tree.write("mms/run/slam_run.cpp", "#include \"apps/mms/console/progress.hpp\"\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 2U);
  expect_in("arrow run -> apps is forbidden", faults[0]);
  expect_in("arrow interfaces -> apps is forbidden", faults[1]);
}

TEST(Architecture, RejectsFolderWithTooManySources) {
  const TempFolder tree;
  for (std::size_t i = 0; i <= kMaxFilesInFolder; ++i) {
    tree.write("mms/core/part" + std::to_string(i) + ".cpp", "int x;\n");
  }
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0], "mms/core: 31 sources, at most 30 are allowed: split it by idea");
}

TEST(Architecture, RejectsHeadersOfEqualName) {
  const TempFolder tree;
  tree.write("mms/core/scene.hpp", "#pragma once\n");
  tree.write("mms/io/text/scene.hpp", "#pragma once\n");
  const auto faults = faults_of(tree);
  ASSERT_EQ(faults.size(), 1U);
  expect_in("mms/io/text/scene.hpp: the name of mms/core/scene.hpp", faults[0]);
}

}  // namespace
}  // namespace mms
