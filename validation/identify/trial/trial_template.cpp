// The folder that `plumbline new-trial` gives to begin with.
#include <cmath>
#include <filesystem>

#include "simulator/trace/table.h"
#include "validation/identify/trial/new_folder.h"
#include "validation/identify/trial/write_trial.h"

namespace plumbline::validation {
namespace {

constexpr const char* kTrial = R"(# One recorded experiment. Lines with a # in front are optional.
plumbline: trial/1            # always this line first
title: What was done, in a few words

model: ../model.yaml          # the robot's model file, relative to this file
role: train                   # train: may be fitted; held-out: may only be predicted, and chooses (another kind of
                              # motion); test: neither, the last error is reported on it

data: data.csv                # .csv with header `name [unit]`, or MATLAB .mat; beside this file
# data_folder_env: MY_DATA    # environment variable naming the folder of the data instead (--data DIR overrides)

time: {column: t, unit: s}    # rising in equal steps; the unit may be left out where the data file states it

commands:                     # what each motor was told, held over each sample: motor of the model -> column
  motor: {column: u_motor, unit: N m}     # any unit of the dimension of the motor's command_unit

measured:                     # what was measured: sensor of the model -> column
  encoder: {column: q_encoder, unit: rad} # rad, deg or m; not counts

# locked:                     # coordinates or motors that were held still by hand or a pin, and where
#   other_motor: {value: 90, unit: deg}

# controllers:                # a controller that ran during the experiment and is known
#   - kind: cascade_pd        # command = velocity_gain (position_gain (reference - q) - dq/dt) + disturbance
#     motor: motor
#     sensor: encoder
#     reference: {column: r_encoder, unit: rad}
#     position_gain: {value: 100, unit: 1/s, source: "where the number comes from"}
#     velocity_gain: {value: 2, unit: N m s/rad, source: "where the number comes from"}
#     disturbance: {column: d_motor, unit: N m}
#     command_limit: {value: 10, unit: N m}
#     velocity_over: 2        # dq/dt differenced over so many samples, 1 or 2; left out: 1

# events: [1.25 s]            # times at which something struck; predictions do not run across them
)";

constexpr const char* kReadme = R"(# A trial: one recorded experiment

1. Put your recording in place of data.csv and say in trial.yaml which column is what.
2. Name your model file, its motors and its sensors in trial.yaml.
3. `plumbline check` this folder: it says in one line what does not fit.

## data.csv

The first line names each column and its unit as `name [unit]`. Every further line is one sample: decimal
points, commas between the columns, no empty fields, at least 20 samples.

| column | meaning |
| --- | --- |
| t [s] | time of the sample; rises in steps that are equal within 1 % |
| u_motor [N m] | command of the motor from this sample to the next, in the motor's command unit |
| q_encoder [rad] | what the sensor read at the time of the sample |

A MATLAB file (.mat, version 5 or 7.3) does as well: every vector is a column of the variable's name, the
columns of a matrix M are M_1, M_2, ... . It holds no units, so trial.yaml must state them.
)";

/// An inertia of 0.1 kg m^2 under a sine of 0.2 N m and 1 Hz, at 100 Hz.
Table example() {
  constexpr Eigen::Index rows = 25;
  constexpr double omega = 6.283185307179586;
  Table table;
  table.columns = {{"t", "s", Eigen::VectorXd(rows)},
                   {"u_motor", "N m", Eigen::VectorXd(rows)},
                   {"q_encoder", "rad", Eigen::VectorXd(rows)}};
  for (Eigen::Index k = 0; k < rows; ++k) {
    const double t = 0.01 * static_cast<double>(k);
    table.columns[0].values[k] = t;
    table.columns[1].values[k] = 0.2 * std::sin(omega * t);
    table.columns[2].values[k] = 2.0 * (t / omega - std::sin(omega * t) / (omega * omega));
  }
  return table;
}

}  // namespace

void new_trial_template(const std::string& folder) {
  write_new_folder(folder, [](const std::string& temporary) {
    const std::filesystem::path in(temporary);
    write_csv(example(), (in / "data.csv").string(), 6);
    write_text_atomically((in / "trial.yaml").string(), kTrial);
    write_text_atomically((in / "README.md").string(), kReadme);
  });
}

}  // namespace plumbline::validation
