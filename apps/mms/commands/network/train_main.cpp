// The program of a build with MMS_TRAINING_ONLY: `mms-torch train`, and nothing else.
#include <CLI/App.hpp>

#include "apps/mms/commands/commands.hpp"
#include "apps/mms/console/run_app.hpp"

int main(int argc, char** argv) {
  CLI::App app("MMS-SLAM: trains the segmentation network; all else is in a whole build", "mms");
  app.set_version_flag("--version", MMS_VERSION);
  app.require_subcommand(1);
  mms::add_train_command(app);
  return mms::run_app(app, argc, argv);
}
