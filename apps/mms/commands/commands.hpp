#pragma once

namespace CLI {
class App;
}

namespace mms {

// The subcommands of the program, each defined in the file of its name.

/// Adds `mms batch LIST -o DIR`: many runs of one list.
void add_batch_command(CLI::App& app);

/// Adds `mms calibration convert`.
void add_calibration_command(CLI::App& app);

/// Adds `mms cameras`: lists the cameras that are plugged in.
void add_cameras_command(CLI::App& app);

/// Adds `mms config dump` and `mms config check FILE`.
void add_config_command(CLI::App& app);

/// Adds `mms convert`: conversion of files, and recovery of a killed run.
void add_convert_command(CLI::App& app);

/// Adds `mms doctor`: capabilities of machine and build, and a short self-test.
void add_doctor_command(CLI::App& app);

/// Adds `mms eval trajectory|drift|map|ghost-points|objects|segmentation`. Each prints a table, or
/// with --json one object, on stdout.
/// @throws Error from its callback
void add_eval_command(CLI::App& app);

/// Adds `mms help COMMAND`.
void add_help_command(CLI::App& app);

/// Adds `mms import`.
void add_import_command(CLI::App& app);

/// Adds `mms info DATA`: content of a recording, and whether its frames can be read.
void add_info_command(CLI::App& app);

/// Adds `mms map export|check|compact`, for map files.
void add_map_command(CLI::App& app);

/// Adds `mms merge`.
void add_merge_command(CLI::App& app);

/// Adds `mms quantize`.
void add_quantize_command(CLI::App& app);

/// Adds `mms reproduce`: the paper's tables and figures.
void add_reproduce_command(CLI::App& app);

/// Adds `mms ros2`: runs the system on topics of ROS 2, and publishes the results.
void add_ros2_command(CLI::App& app);

/// Adds `mms run [DATA]`: runs the system on a recording, with results in a folder.
void add_run_command(CLI::App& app);

/// Adds `mms segment`.
void add_segment_command(CLI::App& app);

/// Adds `mms simulate SCENE -o DIR`, which writes a simulated recording with ground truth, and `mms
/// simulate training-set`.
void add_simulate_command(CLI::App& app);

/// Adds `mms train`; without libtorch it starts `mms-torch` in the same folder.
void add_train_command(CLI::App& app);

/// Adds `mms view`: shows a finished run in a browser.
void add_view_command(CLI::App& app);

}  // namespace mms
