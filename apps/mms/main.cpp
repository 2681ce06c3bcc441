#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <string>

#include "config_command.hpp"
#include "convert_command.hpp"
#include "doctor_command.hpp"
#include "eval_command.hpp"
#include "import_command.hpp"
#include "info_command.hpp"
#include "mms/core/error.hpp"
#include "quantize_command.hpp"
#include "reproduce_command.hpp"
#include "run_command.hpp"
#include "segment_command.hpp"
#include "simulate_command.hpp"
#include "torch_backend.hpp"
#include "usage.hpp"
#include "view_command.hpp"

namespace {

constexpr int kFault = 1;  ///< of the user's data or files
constexpr int kUsage = 2;  ///< of the command line

int fail(const std::string& what, int exit_code = kFault) {
  fmt::print(stderr, "mms: {}\n", what);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "MMS-SLAM: localises a camera or LiDAR among moving people and vehicles and maps "
      "what stands still",
      "mms");
  app.set_version_flag("--version", MMS_VERSION);
  app.require_subcommand(1);
  mms::add_run_command(app);
  mms::add_eval_command(app);
  mms::add_reproduce_command(app);
  mms::add_simulate_command(app);
  mms::add_segment_command(app);
  mms::add_quantize_command(app);
  mms::add_import_command(app);
  mms::add_train_command(app);
  mms::add_view_command(app);
  mms::add_convert_command(app);
  mms::add_info_command(app);
  mms::add_config_command(app);
  mms::add_doctor_command(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked = error.get_exit_code() == 0;  // for help or the version
    return asked ? app.exit(error) : fail(mms::usage_fault(app, error), kUsage);
  } catch (const mms::Error& error) {
    return fail(error.what());
  } catch (const std::bad_alloc&) {
    return fail("out of memory (less data with --frames, or a larger static_map.voxel_size)");
  } catch (const std::exception& error) {
    return fail(error.what());
  }
  return 0;
}
