// SPDX-License-Identifier: BSL-1.0
// Tables of flow curves: the dialects that spreadsheets write, and what is wrong, with the file and the line.
#include <stickslip/io/flow_points.hpp>

#include <doctest/doctest.h>

#include <sstream>

namespace {

using namespace stickslip;

std::vector<FlowPoint> read(const std::string& text) {
  std::istringstream in(text);
  return io::read_flow_points(in, "a.csv");
}

std::string complaint(const std::string& text) {
  try {
    (void)read(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST_CASE("tables of flow points are read with every usual separator and comment") {
  for (const char* text :
       {"0,100\n0.01,140\n0.05,190\n0.2,230\n",
        "# steel\n\nplastic strain,flow stress\n0, 100\n 0.01 ,140 # here\n0.05,190\n0.2,230",
        "\xef\xbb\xbf\"strain, plastic [-]\";\"stress [MPa]\"\r\n0;1e2\r\n0.01;140\r\n0.05;190\r\n\"0.2\";\"230\"\r\n",
        "strain stress\n+0 100\n1e-2\t140\n0.05   190\n\t2E-1 230 \n#\n"}) {
    const auto points = read(text);
    REQUIRE(points.size() == 4);
    CHECK(points[0].strain == 0);
    CHECK(points[0].stress == 100);
    CHECK(points[1].strain == 0.01);
    CHECK(points[3].strain == 0.2);
    CHECK(points[3].stress == 230);
  }
}

TEST_CASE("wrong tables of flow points are refused with file and line") {
  struct Wrong {
    const char *text, *sentence;
  };
  for (const auto& [text, sentence] : {
           Wrong{"", "a.csv: the table needs at least four points, this has 0"},
           {"strain,stress\n", "a.csv: the table needs at least four points, this has 0"},
           {"0,1\n1,2\n2,3\n", "a.csv: the table needs at least four points, this has 3"},
           {"0.1,1\n1,2\n2,3\n3,4\n", "a.csv, line 1: the first point must lie at zero plastic strain"},
           {"# steel\n0,1\n1,2\n\n1,3\n3,4\n", "a.csv, line 5: the plastic strains must ascend"},
           {"0,1\n1,0\n2,3\n3,4\n", "a.csv, line 2: the flow stresses must be positive"},
           {"0,1\n1,-2\n2,3\n3,4\n", "a.csv, line 2: the flow stresses must be positive"},
           {"0,1\n1e-40,2\n2,3\n3,4\n",
            "a.csv, line 2: plastic strains beyond 1e30 or steps of them below 1e-30 cannot be computed with"},
           {"0,1\n1,2\n2,3\n3,1e200\n",
            "a.csv, line 4: flow stresses beyond 1e100 or below 1e-100 cannot be computed with"},
           {"0,1\n1,2,3\n2,3\n3,4\n",
            "a.csv, line 2: a line of the table has two numbers, plastic strain and flow stress, this has 3 cells"},
           {"0,1\n1\n2,3\n3,4\n",
            "a.csv, line 2: a line of the table has two numbers, plastic strain and flow stress, this has 1 cell"},
           {"0,1\n1,\n2,3\n3,4\n", "a.csv, line 2: a number is missing"},
           {"0;1\n0,01;2\n2;3\n3;4\n", "a.csv, line 2: found \"0,01\" where a number should stand"},
           {"0,1\nO.1,2\n2,3\n3,4\n", "a.csv, line 2: found \"O.1\" where a number should stand"},
           {"O,100\n0,1\n1,2\n2,3\n3,4\n", "a.csv, line 1: found \"O\" where a number should stand"},
           {"a,b\nc,d\n0,1\n1,2\n2,3\n3,4\n", "a.csv, line 2: found \"c\" where a number should stand"},
           {"0,1\n1,nan\n2,3\n3,4\n", "a.csv, line 2: the number \"nan\" is not finite"},
           {"0,1\n1,1e999\n2,3\n3,4\n", "a.csv, line 2: the number \"1e999\" is out of range"},
       })
    CHECK(complaint(text) == sentence);
  CHECK(complaint(std::string("0,1\n1,\x01\x00\xff\n", 9)) ==
        "a.csv, line 2: found \"???\" where a number should stand");
}

TEST_CASE("a table of flow points that cannot be opened is named") {
  CHECK_THROWS_WITH_AS((void)io::read_flow_points("/no/such/table.csv"),
                       "cannot read /no/such/table.csv: No such file or directory", std::runtime_error);
}

}  // namespace
