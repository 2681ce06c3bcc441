#pragma once

namespace CLI {
class App;
}

namespace mms {

// The subcommands of the program, each defined in the file of its name.

/// Adds `mms config dump` and `mms config check FILE`.
void add_config_command(CLI::App& app);

/// Adds `mms convert`: files in other formats, and the files of a run that was killed.
void add_convert_command(CLI::App& app);

/// Adds `mms doctor`: what this machine and build can do, and whether the program works on it.
void add_doctor_command(CLI::App& app);

/// Adds `mms eval trajectory|drift|map|residue`. Running one prints a table, or with --json one
/// object with the contract's keys, on stdout. @throws Error from its callback
void add_eval_command(CLI::App& app);

/// Adds `mms import`.
void add_import_command(CLI::App& app);

/// Adds `mms info DATA`: what a recording holds, and whether its frames can be read.
void add_info_command(CLI::App& app);

/// Adds `mms quantize`.
void add_quantize_command(CLI::App& app);

/// Adds `mms reproduce`: the paper's tables and figures by one command.
void add_reproduce_command(CLI::App& app);

/// Adds `mms run [DATA]`: the whole system over a recording, results in a folder.
void add_run_command(CLI::App& app);

/// Adds `mms segment`.
void add_segment_command(CLI::App& app);

/// Adds `mms simulate SCENE -o DIR`, which writes a simulated recording with its truth, and
/// `mms simulate training-set`.
void add_simulate_command(CLI::App& app);

/// Adds `mms train`; without libtorch it hands over to `mms-torch` beside this program.
void add_train_command(CLI::App& app);

/// `mms view`: shows a finished run in a browser.
void add_view_command(CLI::App& app);

}  // namespace mms
