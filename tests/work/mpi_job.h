// A job under mpirun, on this machine.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace plumbline::test {

struct JobOutcome {
  int status = -1;
  std::string out, err;
};

/// Starts `mpirun WORDS...` in a folder; more ranks than cores are allowed.
class MpiJob {
 public:
  MpiJob(const std::vector<std::string>& words, const std::string& folder);
  ~MpiJob();
  MpiJob(const MpiJob&) = delete;
  MpiJob& operator=(const MpiJob&) = delete;

  /// The processes of the ranks, in no order.
  std::vector<pid_t> ranks() const;
  bool is_running();
  JobOutcome wait();

 private:
  std::string out_, err_;
  pid_t pid_ = -1;
  bool ended_ = false;
  int raw_status_ = 0;
};

JobOutcome run_job(const std::vector<std::string>& words, const std::string& folder);

}  // namespace plumbline::test
