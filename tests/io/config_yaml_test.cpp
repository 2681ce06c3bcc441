#include "mms/io/config/config_yaml.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <limits>

#include "mms/core/error.hpp"
#include "mms/io/config/yaml_map.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

enum class Mode { kNone, kFast, kExact };

struct InnerConfig {
  double translation = 0.1;
  int count = 5;
  void visit(ConfigVisitor& v) {
    v.number({"translation", "m", "motion that makes a keyframe"}, translation, {0.0, 10.0});
    v.integer({"count", "", "number of keyframes"}, count, {1, 100});
  }
  bool operator==(const InnerConfig&) const = default;
};

struct OuterConfig {
  bool enabled = true;
  Mode mode = Mode::kFast;
  double limit = std::numeric_limits<double>::infinity();
  InnerConfig keyframes;
  void visit(ConfigVisitor& v) {
    static constexpr std::array<std::string_view, 3> kModes = {"none", "fast", "exact"};
    v.boolean({"enabled", "", "whether it is used"}, enabled);
    v.enumeration({"mode", "", "how it works"}, mode, kModes);
    v.number({"limit", "s", "longest time"}, limit, {0.0});
    v.group({"keyframes", "", "Which frames are kept"}, keyframes);
  }
  bool operator==(const OuterConfig&) const = default;
};

std::string error_of(const std::string& yaml) {
  const TempFolder folder;
  const auto path = folder.write("c.yaml", yaml);
  OuterConfig config;
  const std::string message = message_of<ConfigError>([&] { load_config(path, config); });
  EXPECT_EQ(config, OuterConfig()) << "a failed load must change nothing";
  expect_in(path.string(), message);
  return message.substr(std::min(path.string().size(), message.size()));
}

TEST(ConfigYaml, SetsGivenKeysAndKeepsOthers) {
  const TempFolder folder;
  OuterConfig config;
  load_config(folder.write("c.yaml", "mode: exact\nkeyframes:\n  translation: 2\n"), config);
  EXPECT_EQ(config.mode, Mode::kExact);
  EXPECT_EQ(config.keyframes.translation, 2.0);
  EXPECT_EQ(config.keyframes.count, 5);
  load_config(folder.write("c.yaml", "enabled: false\nkeyframes:\n"), config);
  EXPECT_FALSE(config.enabled);
  EXPECT_EQ(config.mode, Mode::kExact);
  load_config(folder.write("c.yaml", ""), config);
}

TEST(ConfigYaml, DumpIsDocumented) {
  EXPECT_EQ(dump_config(OuterConfig()),
            "enabled: true  # whether it is used, true or false\n"
            "mode: fast  # how it works, none | fast | exact\n"
            "limit: .inf  # longest time [s], at least 0\n"
            "# Which frames are kept\n"
            "keyframes:\n"
            "  translation: 0.1  # motion that makes a keyframe [m], 0 to 10\n"
            "  count: 5  # number of keyframes, 1 to 100\n");
}

TEST(ConfigYaml, ListsChangedSettings) {
  OuterConfig config;
  const std::string defaults = dump_config(OuterConfig());
  EXPECT_TRUE(changed_settings(dump_config(config), defaults).empty());
  config.mode = Mode::kExact;
  config.keyframes.count = 7;
  EXPECT_EQ(changed_settings(dump_config(config), defaults),
            (std::vector<std::string>{"mode: exact", "keyframes.count: 7"}));
}

TEST(ConfigYaml, DumpRoundTrips) {
  const TempFolder folder;
  OuterConfig config;
  config.enabled = false;
  config.mode = Mode::kNone;
  config.limit = 1e-7;
  config.keyframes = {1.0 / 3.0, 42};
  OuterConfig loaded;
  load_config(folder.write("c.yaml", dump_config(config)), loaded);
  EXPECT_EQ(loaded, config);
  load_config(folder.write("c.yaml", dump_config(OuterConfig())), loaded);
  EXPECT_EQ(loaded, OuterConfig());
}

TEST(ConfigYaml, UnknownKeysSuggestNearest) {
  EXPECT_EQ(error_of("enabled: true\nkeyframes:\n  translatoin: 1\n"),
            ":3: unknown key 'keyframes.translatoin' (did you mean 'translation'?)");
  EXPECT_EQ(error_of("x: 1\n"), ":1: unknown key 'x' (known: enabled, mode, limit, keyframes)");
}

TEST(ConfigYaml, WrongTypesNameExpectedType) {
  EXPECT_EQ(error_of("keyframes:\n  translation: far\n"),
            ":2: keyframes.translation is 'far', expected a number: 0 to 10");
  EXPECT_EQ(error_of("keyframes: {count: 2.5}\n"),
            ":1: keyframes.count is '2.5', expected an integer: 1 to 100");
  EXPECT_EQ(error_of("enabled: yes\n"), ":1: enabled is 'yes', allowed: true, false");
  EXPECT_EQ(error_of("limit: [1, 2]\n"), ":1: limit is a list, expected a number: at least 0");
  EXPECT_EQ(error_of("limit: '1'\n"), ":1: limit is '1', expected a number: at least 0");
  EXPECT_EQ(error_of("keyframes: 3\n"), ":1: keyframes is '3', expected lines of 'key: value'");
  expect_in("limit is empty, expected a number", error_of("limit:\n"));
  expect_in("limit is '.nan', expected a number", error_of("limit: .nan\n"));
}

TEST(ConfigYaml, ValuesOutOfRangeNameRange) {
  EXPECT_EQ(error_of("keyframes:\n  translation: 10.5\n"),
            ":2: keyframes.translation is 10.5, allowed: 0 to 10");
  EXPECT_EQ(error_of("keyframes:\n  translation: .inf\n"),
            ":2: keyframes.translation is .inf, allowed: 0 to 10");
  EXPECT_EQ(error_of("keyframes:\n  count: 0\n"), ":2: keyframes.count is 0, allowed: 1 to 100");
  EXPECT_EQ(error_of("mode: exakt\n"),
            ":1: mode is 'exakt', allowed: one of none, fast, exact (did you mean 'exact'?)");
}

TEST(ConfigYaml, RejectsDuplicateKeys) {
  EXPECT_EQ(error_of("enabled: true\nenabled: false\n"),
            ":2: enabled appears twice (keep one of them)");
  expect_in(":3: keyframes.count appears twice", error_of("keyframes:\n  count: 1\n  count: 2\n"));
}

TEST(ConfigYaml, RejectsInvalidYaml) {
  expect_in("is not YAML", error_of("a: [1, 2\nb: }"));
  expect_in("is not YAML", error_of("\t- x: {"));
  expect_in("expected lines of 'key: value'", error_of("just words\n"));
  expect_in("expected a key", error_of("[1, 2]: 3\n"));
  error_of(std::string("\x00\x01\xff\xfe garbage", 12));
  error_of(std::string(2000, '['));
}

TEST(ConfigYaml, ReadsManyDirectivesAndKeysQuickly) {
  std::string text;
  for (int i = 0; i < 300'000; ++i) text += "%\n";
  for (int i = 0; i < 20'000; ++i) text += "key" + std::to_string(i) + ": 1\n";
  const auto begin = std::chrono::steady_clock::now();
  YamlMap::parse(text, "test");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST(ConfigYaml, MissingFilesAreFileErrors) {
  OuterConfig config;
  message_of<FileError>([&] { load_config("/no/such/config.yaml", config); });
}

}  // namespace
}  // namespace mms
