// Independent pieces of long work: tasks in, results in order out. Threads or MPI ranks do them.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace plumbline::work {

struct Task {
  std::string name;                  ///< what it is; alike on all ranks
  std::function<std::string()> run;  ///< computes the result, as bytes
  double seconds = 0.0;  ///< that it took at an earlier time; 0: not known. The longest goes first
};

/// What is to happen while tasks run. All but `stop` is called on the first rank only, one call at a time.
struct Watch {
  const std::atomic<bool>* stop = nullptr;  ///< raised: no further task is begun
  /// A result that is there already: the task is not run.
  std::function<std::optional<std::string>(std::size_t task)> known{};
  /// As soon as a result is there, in whatever order.
  std::function<void(std::size_t task, const std::string& result, double seconds)> done{};
};

struct Results {
  bool stopped = false;            ///< then some results are missing, and empty here
  std::vector<std::string> bytes;  ///< in the order of the tasks, the same on all ranks
};

/// A task, or a whole rank, that failed elsewhere: the message as it was there.
struct Failed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Ranks that do not go together: other programs, a folder that they do not share, a rank that cannot read
/// what the others can.
struct Refused : Failed {
  using Failed::Failed;
};

/// Whoever does the work. With several ranks each of them runs the whole program: all must come to the same
/// calls of run() with the same tasks, which is the case when what a program does follows from its input and
/// from earlier results alone. Then nothing but results need be sent, and they may be of any kind.
class Workers {
 public:
  Workers() = default;
  virtual ~Workers() = default;
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// That take part in a call of run() made here; within a task 1.
  virtual int ranks() const { return 1; }
  /// Only the first rank prints and writes files.
  virtual bool is_first() const { return true; }
  /// Runs the tasks. The first exception of a task is thrown again, on other ranks as Failed. A task that
  /// itself calls run() has its tasks done one after the other where it runs.
  virtual Results run(const std::vector<Task>& tasks, const Watch& watch) = 0;
  /// Throws Refused, naming a rank and its machine, where not all ranks have the same `identity`; `what` says
  /// what that stands for ("version of the program").
  virtual void check_same(const std::string& /*what*/, const std::string& /*identity*/) {}
  /// The same where not all of them see what the first one writes into this folder.
  virtual void check_shared(const std::string& /*folder*/) {}
  /// Tells the first rank why this one cannot go on.
  virtual void fail(const std::string& /*why*/) {}
  /// The last call: all ranks end. Returns the exit status of this process.
  virtual int finish(int status) { return status; }
};

/// So many tasks at a time in this process; with 1 no thread is begun.
class Threads : public Workers {
 public:
  explicit Threads(int at_a_time) : at_a_time_(at_a_time) {}
  Results run(const std::vector<Task>& tasks, const Watch& watch) override;

 private:
  int at_a_time_;
};

/// The order in which tasks are begun: the longest first, those of unknown duration before all others.
std::vector<std::size_t> order_of(const std::vector<Task>& tasks);
/// Those whose results are not there already, in the order in which they are begun; known results are taken
/// over.
std::vector<std::size_t> open_tasks(const std::vector<Task>& tasks, const Watch& watch, Results& results);

/// The MPI that the program was built with ("Open MPI 4.1.4"); empty: none.
std::string mpi_name();

/// The ranks of an MPI job when this process was started as one of them, otherwise Threads(1). `times`: a
/// file to which the first rank writes a line for each task (docs/batch.md); empty: none. Throws Refused
/// when the program is one of several that were started together but has no MPI.
std::unique_ptr<Workers> start(const std::string& times);

/// Was this process started as one of several, by mpirun or srun? How many, from the environment; 1: no.
int started_together();

/// Threads that this process should use: its cores, shared with the other ranks on the machine.
int cores();

}  // namespace plumbline::work
