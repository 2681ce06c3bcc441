#include <CLI/App.hpp>

#include "apps/mms/commands/commands.hpp"
#include "apps/mms/console/run_app.hpp"
#include "apps/mms/console/standard_streams.hpp"
#include "apps/mms/console/waiting_threads.hpp"

int main(int argc, char** argv) {
  mms::open_missing_streams();
  mms::let_waiting_threads_sleep(argv);
  CLI::App app(
      "MMS-SLAM: localizes a camera or LiDAR among moving people and vehicles and maps the static "
      "scene",
      "mms");
  app.set_version_flag("--version", MMS_VERSION);
  app.require_subcommand(1);
  mms::add_run_command(app);
  mms::add_ros2_command(app);
  mms::add_cameras_command(app);
  mms::add_batch_command(app);
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
  mms::add_map_command(app);
  mms::add_merge_command(app);
  mms::add_calibration_command(app);
  mms::add_config_command(app);
  mms::add_doctor_command(app);
  mms::add_help_command(app);
  return mms::run_app(app, argc, argv);
}
