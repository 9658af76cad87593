// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/io/text.hpp>
#include <stickslip/material/flow_points.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace stickslip::io {

namespace detail {

inline std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

// The first two cells of a line, and the number of cells: a valid line has two. Semicolons separate them if there are
// any, else commas, else blanks.
struct CsvCells {
  std::array<std::string_view, 2> cell;
  std::size_t count = 0;

  explicit CsvCells(std::string_view line) {
    const char mark = line.find(';') != line.npos ? ';' : line.find(',') != line.npos ? ',' : ' ';
    while (count == 0 || !line.empty()) {
      const std::size_t end = mark == ' ' ? line.find_first_of(" \t") : line.find(mark);
      if (count < cell.size()) cell[count] = unquoted(trimmed(line.substr(0, end)));
      ++count;
      if (end == line.npos) break;
      line.remove_prefix(end + 1);
      if (mark == ' ') line = trimmed(line);
      if (line.empty()) ++count;  // a separator with nothing behind it
    }
  }
  static std::string_view unquoted(std::string_view text) {
    if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = trimmed(text.substr(1, text.size() - 2));
    return text;
  }
};

// Names of columns begin with a letter; of the numbers only "inf" and "nan" do, which are refused anyway.
inline bool names_columns(const CsvCells& cells) {
  if (cells.cell[0].empty()) return false;
  for (const std::string_view cell : cells.cell)
    if (!cell.empty() && std::string_view("0123456789+-.").find(cell.front()) != std::string_view::npos) return false;
  return true;
}

inline std::vector<FlowPoint> read_flow_points(std::string_view bytes, const std::string& name) {
  Text text(name, without_mark(bytes));
  std::vector<FlowPoint> points;
  std::vector<std::size_t> lines;
  bool first = true;
  while (text.next_line()) {
    std::string_view line = text.rest_of_line();
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const CsvCells cells(line);
    const bool header = first && names_columns(cells);
    first = false;
    if (header) continue;
    if (cells.count != 2)
      text.fail("a line of the table has two numbers, plastic strain and flow stress, this has " +
                std::to_string(cells.count) + (cells.count == 1 ? " cell" : " cells"));
    for (const std::string_view cell : cells.cell)
      if (cell.empty()) text.fail("a number is missing");
    points.push_back({text.real(cells.cell[0]), text.real(cells.cell[1])});
    lines.push_back(text.line());
  }
  if (const auto fault = fault_of(points)) {
    if (fault->point) text.fail(lines[*fault->point], fault->what);
    text.fail_whole(fault->what + ", this has " + std::to_string(points.size()));
  }
  return points;
}

}  // namespace detail

/// Reads the points of a flow curve from a table: per line plastic strain [-] and flow stress [stress], separated by a
/// comma, a semicolon or blanks. A first line of column names, empty lines and text behind a # are ignored. The points
/// obey the rules of `TabulatedHardening` (fault_of). `name` stands for the table in messages. Throws
/// std::runtime_error, naming file and line, if the table cannot be read or is no flow curve. Memory is proportional to
/// the size of the file.
inline std::vector<FlowPoint> read_flow_points(std::istream& in, const std::string& name) {
  return detail::read_flow_points(detail::read_all(in, name), name);
}

/// The same from a file.
inline std::vector<FlowPoint> read_flow_points(const std::filesystem::path& path) {
  return detail::read_flow_points(detail::read_all(path), path.string());
}

}  // namespace stickslip::io
