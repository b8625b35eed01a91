#pragma once

#include "flight/command_line/output.h"
#include "flight/command_line/subcommand.h"

/// What every subcommand of `saker` is made of; the vehicle's programs share it.
namespace saker::tools {

using flight::Commands;
using flight::CommonOptions;
using flight::Description;
using flight::goes_on;
using flight::log_of_run;
using flight::Output;
using flight::output_file;
using flight::OutputFolder;
using flight::run_command_line;
using flight::start_logging;

}  // namespace saker::tools
