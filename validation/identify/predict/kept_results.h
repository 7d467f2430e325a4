// Results of long work in a file as they come, so that the same work goes on from there after an
// interruption.
#pragma once

#include <Eigen/Core>
#include <fstream>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace plumbline::work {
class Workers;
}

namespace plumbline::validation {

/// Numbers in a row; vectors with their count before them.
class Record {
 public:
  Record() = default;
  explicit Record(std::vector<double> numbers) : numbers_(std::move(numbers)) {}

  Record& add(double number);
  Record& add(const Eigen::VectorXd& vector);
  Record& add(const std::vector<Eigen::VectorXd>& vectors);
  const std::vector<double>& numbers() const { return numbers_; }

 private:
  std::vector<double> numbers_;
};

/// Reads a record in the order in which it was added. Throws std::out_of_range behind its end.
class RecordReader {
 public:
  explicit RecordReader(const Record& record) : numbers_(record.numbers()) {}

  double number() { return numbers_.at(next_++); }
  Eigen::VectorXd vector();
  std::vector<Eigen::VectorXd> vectors();

 private:
  std::size_t count();

  const std::vector<double>& numbers_;
  std::size_t next_ = 0;
};

/// All that a result depends on beside the inputs of its file.
struct ResultKey {
  std::string words;  ///< lines
  Record numbers{};

  std::string hash() const;
};

/// Results in memory or also in a file: a first line that says from which inputs, then a line for each result
/// (docs/formats.md).
class KeptResults {
 public:
  /// Of several ranks only the first one writes.
  enum class Access { append, read };

  /// In memory only.
  KeptResults() = default;

  /// Begins the file, or goes on from it. `inputs` is a hash of what all its results depend on. A last line
  /// that an interruption has cut off is removed. Throws InputError (file, line, found, expected) when the
  /// file cannot be written, is another kind of file, or has results of other inputs.
  KeptResults(const std::string& file, const std::string& inputs, Access access = Access::append);

  /// The result that is kept under this key; else what `compute` returns, which is kept from then on.
  Record get(const ResultKey& key, const std::function<Record()>& compute);

  /// Results that were in the file when it was opened.
  std::size_t found() const { return found_; }

  /// Ranks among which work is shared (work_ahead.h); they must live as long. None: nullptr.
  void share_with(work::Workers* workers) { workers_ = workers; }
  work::Workers* workers() const { return workers_; }

  /// From now on results that are computed here are listed, too, until the list is ended: as lines of the
  /// file.
  void begin_list();
  std::string end_list();
  /// Keeps the results of another rank's list.
  void take(const std::string& list);

  /// False once a result could not be written: work goes on without keeping, since a full disk says nothing
  /// of a candidate.
  bool is_written() const { return out_.good(); }

 private:
  void read(const std::string& inputs);
  void keep(const std::string& hash, const Record& record, bool is_own);

  std::string file_;
  std::unordered_map<std::string, Record> records_;
  std::size_t found_ = 0;
  std::optional<std::size_t> whole_;  // bytes of the file without a line that was cut off
  std::mutex mutex_;
  std::ofstream out_;
  work::Workers* workers_ = nullptr;
  bool is_listing_ = false;
  std::string list_;
};

}  // namespace plumbline::validation
