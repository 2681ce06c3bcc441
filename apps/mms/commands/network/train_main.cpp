// The program of a build with MMS_TRAINING_ONLY: only `mms-torch train`.
#include <CLI/App.hpp>

#include "apps/mms/commands/commands.hpp"
#include "apps/mms/console/run_app.hpp"

int main(int argc, char** argv) {
  CLI::App app("MMS-SLAM: trains the segmentation network; other commands are in a full build",
               "mms");
  app.set_version_flag("--version", MMS_VERSION);
  app.require_subcommand(1);
  mms::add_train_command(app);
  return mms::run_app(app, argc, argv);
}
