// HDF5 files: datasets of numbers as columns.
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <mutex>

#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/log_file.h"

namespace plumbline {
namespace {

/// HDF5 is not built for threads and prints its complaints by default.
std::mutex& quiet_hdf5() {
  static std::mutex mutex;
  return mutex;
}

/// Closes what the library opened.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) {
      close_(id_);
    }
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): it is one to the library
  bool is_open() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

struct Dataset {
  std::string path;  ///< without the first slash
  hsize_t rows = 0, columns = 1;
  std::vector<std::string> fields{};  ///< of a compound; empty: plain numbers
};

bool is_number(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT || kind == H5T_ENUM;
}

/// What an object is as a table of numbers; no rows where it is none.
Dataset described(hid_t file, const std::string& path) {
  Dataset about{path};
  const Handle set(H5Dopen2(file, ("/" + path).c_str(), H5P_DEFAULT), H5Dclose);
  const Handle space(H5Dget_space(set), H5Sclose);
  const Handle type(H5Dget_type(set), H5Tclose);
  const int rank = space.is_open() ? H5Sget_simple_extent_ndims(space) : -1;
  if (rank != 1 && rank != 2) {
    return about;
  }
  hsize_t size[2] = {0, 1};  // NOLINT(modernize-avoid-c-arrays): the library's form
  H5Sget_simple_extent_dims(space, size, nullptr);
  if (H5Tget_class(type) == H5T_COMPOUND) {
    for (int i = 0; i < H5Tget_nmembers(type); ++i) {
      const Handle member(H5Tget_member_type(type, static_cast<unsigned>(i)), H5Tclose);
      if (is_number(member)) {
        char* name = H5Tget_member_name(type, static_cast<unsigned>(i));
        about.fields.emplace_back(name);
        H5free_memory(name);
      }
    }
    about.rows = rank == 1 && !about.fields.empty() ? size[0] : 0;
    return about;
  }
  if (is_number(type)) {
    about.rows = size[0];
    about.columns = rank == 2 ? size[1] : 1;
    if (rank == 2 && size[0] == 1) {  // a row vector, as MATLAB writes them
      std::swap(about.rows, about.columns);
    }
  }
  return about;
}

herr_t add_path(hid_t /*group*/, const char* name, const H5O_info_t* info, void* paths) {
  if (info->type == H5O_TYPE_DATASET) {
    static_cast<std::vector<std::string>*>(paths)->emplace_back(name);
  }
  return 0;
}

std::vector<double> numbers(hid_t file, const Dataset& about, const std::string& field) {
  const Handle set(H5Dopen2(file, ("/" + about.path).c_str(), H5P_DEFAULT), H5Dclose);
  std::vector<double> values(about.rows * about.columns);
  herr_t status = 0;
  if (field.empty()) {
    status = H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  } else {
    const Handle memory(H5Tcreate(H5T_COMPOUND, sizeof(double)), H5Tclose);
    H5Tinsert(memory, field.c_str(), 0, H5T_NATIVE_DOUBLE);
    status = H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
  if (status < 0) {
    throw InputError({"", 0, about.path}, "data that cannot be read", "a whole dataset");
  }
  return values;
}

void add_column(const std::string& name, const std::vector<double>& values, std::size_t first,
                std::size_t stride, std::size_t rows, LogFile& log) {
  Column column{name, "", Eigen::VectorXd(static_cast<Eigen::Index>(rows))};
  for (std::size_t k = 0; k < rows; ++k) {
    double value = values[first + k * stride];
    if (!std::isfinite(value)) {
      note_bad_cell(name, {0, static_cast<long>(k) + 1, std::isnan(value) ? "nan" : "inf", std::isnan(value)},
                    log);
      value = std::numeric_limits<double>::quiet_NaN();
    }
    column.values[static_cast<Eigen::Index>(k)] = value;
  }
  log.table.columns.push_back(std::move(column));
}

void add_dataset(hid_t file, const Dataset& about, LogFile& log) {
  for (const std::string& field : about.fields) {
    add_column(about.path + "." + field, numbers(file, about, field), 0, 1, about.rows, log);
  }
  if (about.fields.empty()) {
    const std::vector<double> values = numbers(file, about, "");
    for (std::size_t i = 0; i < about.columns; ++i) {
      add_column(about.columns == 1 ? about.path : about.path + "_" + std::to_string(i + 1), values, i,
                 about.columns, about.rows, log);
    }
  }
}

std::string without_slash(const std::string& path) { return path.substr(path.find_first_not_of('/')); }

/// Does a column that was asked for come from this dataset?
bool is_asked_for(const Dataset& about, const std::vector<std::string>& wanted) {
  return std::any_of(wanted.begin(), wanted.end(), [&](const std::string& name) {
    const std::string plain = name.find_first_not_of('/') == std::string::npos ? name : without_slash(name);
    const std::size_t length = about.path.size();
    return plain == about.path || (plain.size() > length && plain.compare(0, length, about.path) == 0 &&
                                   (plain[length] == '_' || plain[length] == '.'));
  });
}

/// A damaged file may claim any size.
bool size_is_credible(const Dataset& about, std::size_t file_bytes) {
  return static_cast<double>(about.rows) * static_cast<double>(about.columns) <=
         1100.0 * static_cast<double>(file_bytes) + 4096.0;
}

}  // namespace

LogFile read_hdf5_log(const std::string& path, const std::vector<std::string>& wanted) {
  const std::size_t file_bytes = read_text(path).size();  // says what is wrong with the path, if anything
  const std::lock_guard<std::mutex> lock(quiet_hdf5());
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  std::vector<std::string> paths;
  if (!file.is_open() || H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, add_path, &paths, H5O_INFO_BASIC) < 0) {
    throw InputError({path, 0, ""}, "something that is no whole HDF5 file", "an HDF5 file");
  }
  std::vector<Dataset> tables;
  for (const std::string& one : paths) {
    const Dataset about = described(file, one);
    if (about.rows > 1 && size_is_credible(about, file_bytes)) {
      tables.push_back(about);
    }
  }
  if (tables.empty()) {
    throw InputError({path, 0, ""}, "no dataset of numbers with one or two dimensions", "at least one");
  }
  LogFile log;
  log.table.file = path;
  std::vector<Dataset> chosen;
  std::copy_if(tables.begin(), tables.end(), std::back_inserter(chosen),
               [&](const Dataset& about) { return is_asked_for(about, wanted); });
  if (wanted.empty() || chosen.empty()) {
    hsize_t longest = 0;
    for (const Dataset& about : tables) {
      longest = std::max(longest, about.rows);
    }
    chosen.clear();
    for (const Dataset& about : tables) {
      if (about.rows == longest) {
        chosen.push_back(about);
      } else {
        log.remarks.push_back("/" + about.path + " has " + std::to_string(about.rows) + " rows, not " +
                              std::to_string(longest) + ", and is left out.");
      }
    }
  }
  for (const Dataset& about : chosen) {
    if (about.rows != chosen.front().rows) {
      throw InputError({path, 0, "/" + about.path}, std::to_string(about.rows) + " rows",
                       std::to_string(chosen.front().rows) + " as /" + chosen.front().path +
                           " has: the columns of a trial have one length");
    }
    add_dataset(file, about, log);
  }
  return log;
}

}  // namespace plumbline
