// MATLAB files through matio.
#include <matio.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>

#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/mat_containers.h"
#include "simulator/trace/table.h"

namespace plumbline {
namespace {

struct CloseFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatFile = std::unique_ptr<mat_t, CloseFile>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

void ignore_message(int /*level*/, char* /*message*/) {}

/// matio writes its complaints to standard error by default, and HDF5 underneath it is not built for threads.
std::mutex& quiet_matio() {
  static std::mutex mutex;
  static const int silenced = Mat_LogInitFunc("", ignore_message);
  static_cast<void>(silenced);
  return mutex;
}

template <typename Number>
Eigen::MatrixXd as_matrix(const matvar_t& variable, Eigen::Index rows, Eigen::Index columns) {
  using Matrix = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  return Eigen::Map<const Matrix>(static_cast<const Number*>(variable.data), rows, columns)
      .template cast<double>();
}

std::optional<Eigen::MatrixXd> numbers_of(const matvar_t& variable) {
  const auto rows = static_cast<Eigen::Index>(variable.dims[0]);
  const auto columns = static_cast<Eigen::Index>(variable.dims[1]);
  switch (variable.data_type) {
    case MAT_T_DOUBLE:
      return as_matrix<double>(variable, rows, columns);
    case MAT_T_SINGLE:
      return as_matrix<float>(variable, rows, columns);
    case MAT_T_INT8:
      return as_matrix<std::int8_t>(variable, rows, columns);
    case MAT_T_UINT8:
      return as_matrix<std::uint8_t>(variable, rows, columns);
    case MAT_T_INT16:
      return as_matrix<std::int16_t>(variable, rows, columns);
    case MAT_T_UINT16:
      return as_matrix<std::uint16_t>(variable, rows, columns);
    case MAT_T_INT32:
      return as_matrix<std::int32_t>(variable, rows, columns);
    case MAT_T_UINT32:
      return as_matrix<std::uint32_t>(variable, rows, columns);
    case MAT_T_INT64:
      return as_matrix<std::int64_t>(variable, rows, columns);
    case MAT_T_UINT64:
      return as_matrix<std::uint64_t>(variable, rows, columns);
    default:
      return std::nullopt;
  }
}

bool is_number_class(matio_classes type) { return type >= MAT_C_DOUBLE && type <= MAT_C_UINT64; }

/// A real, full, two-dimensional array of numbers.
bool is_real_matrix(const matvar_t& variable) {
  return variable.name != nullptr && is_number_class(variable.class_type) && variable.isComplex == 0 &&
         variable.isLogical == 0 && variable.rank == 2 && variable.dims != nullptr && variable.dims[0] > 0 &&
         variable.dims[1] > 0;
}

/// A damaged file may claim any size: compression gains at most about a factor of 1000 (zlib).
bool size_is_credible(const matvar_t& variable, std::uintmax_t file_bytes) {
  const double claimed = 8.0 * static_cast<double>(variable.dims[0]) * static_cast<double>(variable.dims[1]);
  return claimed <= 1100.0 * static_cast<double>(file_bytes) + 4096.0;
}

std::vector<Column> columns_of(const std::string& name, const Eigen::MatrixXd& matrix) {
  if (matrix.rows() == 1 || matrix.cols() == 1) {
    return {{name, "", Eigen::Map<const Eigen::VectorXd>(matrix.data(), matrix.size())}};
  }
  std::vector<Column> columns;
  for (Eigen::Index i = 0; i < matrix.cols(); ++i) {
    columns.push_back({name + "_" + std::to_string(i + 1), "", matrix.col(i)});
  }
  return columns;
}

Table read_variables(mat_t* file, const std::string& path) {
  Table table;
  table.file = path;
  const std::uintmax_t file_bytes = std::filesystem::file_size(path);
  while (const Variable variable{Mat_VarReadNextInfo(file)}) {
    if (!is_real_matrix(*variable)) {
      continue;
    }
    const std::string name = variable->name;
    if (!size_is_credible(*variable, file_bytes) || Mat_VarReadDataAll(file, variable.get()) != 0 ||
        variable->data == nullptr) {
      throw InputError({path, 0, name}, "damaged data", "a whole MATLAB file");
    }
    if (const auto matrix = numbers_of(*variable)) {
      for (Column& column : columns_of(name, *matrix)) {
        table.columns.push_back(std::move(column));
      }
    }
  }
  return table;
}

/// A table has one length: the longest. Scalars and other vectors are not part of the recording.
void keep_longest(Table& table) {
  Eigen::Index longest = 0;
  for (const Column& column : table.columns) {
    longest = std::max(longest, column.values.size());
  }
  const auto shorter = [longest](const Column& column) { return column.values.size() < longest; };
  table.columns.erase(std::remove_if(table.columns.begin(), table.columns.end(), shorter),
                      table.columns.end());
  if (longest < 2) {
    throw InputError({table.file, 0, ""}, "no vector of numbers", "at least one real vector or matrix");
  }
}

void refuse_doubles(const Table& table) {
  std::set<std::string> seen;
  for (const Column& column : table.columns) {
    if (!seen.insert(column.name).second) {
      throw InputError({table.file, 0, column.name}, "this column name twice",
                       "each name once (a matrix gives NAME_1, NAME_2, ...)");
    }
  }
}

/// MATLAB's names: a letter, then letters, digits and underscores, 63 at most.
std::string matlab_name(const std::string& name, std::set<std::string>& taken) {
  constexpr std::size_t longest = 63;
  std::string legal;
  for (const char c : name) {
    legal += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  }
  if (legal.empty() || std::isalpha(static_cast<unsigned char>(legal.front())) == 0) {
    legal.insert(0, "x");
  }
  legal.resize(std::min(legal.size(), longest - 4));
  const std::string stem = legal;
  for (int i = 2; !taken.insert(legal).second; ++i) {
    legal = stem + "_" + std::to_string(i);
  }
  return legal;
}

void write_variable(mat_t* file, matvar_t* variable) {
  const Variable owner(variable);
  if (variable == nullptr || Mat_VarWrite(file, variable, MAT_COMPRESSION_NONE) != 0) {
    throw InputError("the MATLAB file cannot be written");
  }
}

void write_columns(mat_t* file, const Table& table) {
  std::set<std::string> taken{"units"};
  std::vector<std::string> names;
  for (const Column& column : table.columns) {
    names.push_back(matlab_name(column.name, taken));
    std::array<std::size_t, 2> size{static_cast<std::size_t>(column.values.size()), 1};
    Eigen::VectorXd values = column.values;
    write_variable(file, Mat_VarCreate(names.back().c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(),
                                       values.data(), 0));
  }
  std::vector<const char*> fields;
  fields.reserve(names.size());
  for (const std::string& name : names) {
    fields.push_back(name.c_str());
  }
  std::array<std::size_t, 2> one{1, 1};
  Variable units(
      Mat_VarCreateStruct("units", 2, one.data(), fields.data(), static_cast<unsigned>(fields.size())));
  for (std::size_t i = 0; units != nullptr && i < fields.size(); ++i) {
    std::string unit = table.columns[i].unit;
    std::array<std::size_t, 2> size{1, unit.size()};
    Mat_VarSetStructFieldByName(
        units.get(), fields[i], 0,
        Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF8, 2, size.data(), unit.data(), 0));
  }
  write_variable(file, units.release());
}

}  // namespace

Table read_mat(const std::string& path) {
  constexpr std::size_t header_bytes = 128;
  const std::string bytes = read_text(path);
  if (bytes.size() < header_bytes) {
    throw InputError({path, 0, ""}, "a file shorter than a MATLAB header", "a MATLAB file, version 5 or 7.3");
  }
  if (const auto name = overgrown_container(bytes)) {
    throw InputError({path, 0, *name}, "damaged data", "a whole MATLAB file");
  }
  const std::lock_guard<std::mutex> lock(quiet_matio());
  const MatFile file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (file == nullptr || Mat_GetVersion(file.get()) == MAT_FT_MAT4) {
    throw InputError({path, 0, ""}, "something else", "a MATLAB file, version 5 or 7.3");
  }
  Table table = read_variables(file.get(), path);
  keep_longest(table);
  refuse_doubles(table);
  return table;
}

void write_mat(const Table& table, const std::string& path) {
  for (const Column& column : table.columns) {
    if (column.values.size() != table.rows()) {
      throw std::invalid_argument("column \"" + column.name + "\" is not as long as the first");
    }
  }
  replace_file(path, [&table](const std::string& temporary) {
    const std::lock_guard<std::mutex> lock(quiet_matio());
    const MatFile file(Mat_CreateVer(temporary.c_str(), "columns with units", MAT_FT_MAT5));
    if (file == nullptr) {
      throw InputError("the folder cannot be written");
    }
    write_columns(file.get(), table);
  });
}

}  // namespace plumbline
