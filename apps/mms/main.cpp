#include <CLI/App.hpp>

#include "config_command.hpp"
#include "convert_command.hpp"
#include "doctor_command.hpp"
#include "eval_command.hpp"
#include "import_command.hpp"
#include "info_command.hpp"
#include "quantize_command.hpp"
#include "reproduce_command.hpp"
#include "run_app.hpp"
#include "run_command.hpp"
#include "segment_command.hpp"
#include "simulate_command.hpp"
#include "torch_backend.hpp"
#include "view_command.hpp"
#include "waiting_threads.hpp"

int main(int argc, char** argv) {
  mms::let_waiting_threads_sleep(argv);
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
  return mms::run_app(app, argc, argv);
}
