// SPDX-License-Identifier: BSL-1.0
#include "record.hpp"

#include "outputs.hpp"
#include "pictures.hpp"

#include <nlohmann/json.hpp>

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <ostream>
#include <stdexcept>

namespace examples {

namespace {

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

bool on_terminal(const Options& options) {
  return !options.quiet && isatty(STDERR_FILENO) != 0;
}

std::string fixed(double x, int digits) {
  std::array<char, 400> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::fixed, digits).ptr};
}

nlohmann::ordered_json to_json(const Options& options, const Record& r) {
  nlohmann::ordered_json j;
  j["benchmark"] = r.labels.name;
  j["friction"] = options.friction;
  j["mu"] = options.mu;
  j["solver"] = options.solver;
  j["kinematics"] = r.labels.kinematics;
  j["material"] = r.labels.material;
  if (const auto element = options.parameters.find("element"); element != options.parameters.end())
    j["element"] = element_names[static_cast<std::size_t>(element->second)];
  j["elements"] = r.elements;
  j["unknowns"] = r.unknowns;
  j["symmetric_storage"] = r.symmetric_storage;
  j["completed"] = static_cast<bool>(r.outcome);
  j["steps"] = r.report.steps;
  j["iterations"] = r.report.iterations;
  j["rejected_steps"] = r.report.rejected_steps;
  j["factorizations"] = r.report.work.factorizations;
  j["indefinite_factorizations"] = r.report.work.indefinite_factorizations;
  j["line_search_cuts"] = r.report.work.line_search_cuts;
  j["evaluations"] = r.report.work.evaluations;
  j["tangents_unused"] = r.report.work.tangents_unused;
  j["evaluations_repeated"] = r.report.work.evaluations_repeated;
  j["inner_iterations"] = r.report.work.corrections;
  j["seconds_total"] = r.seconds;
  j["seconds_assembly"] = r.report.timings.assembly;
  j["seconds_contact"] = r.report.timings.contact;
  j["seconds_factorization"] = r.report.timings.factorization;
  j["seconds_solve"] = r.report.timings.solve;
  j["seconds_estimates"] = r.report.timings.estimates;
  j["factor_mb"] = static_cast<double>(r.report.work.factor_bytes) / (1 << 20);
  j["peak_memory_mb"] = peak_memory_mb();
  j["max_penetration_mm"] = r.report.max_penetration;
  j["max_slip_mm"] = r.report.max_slip;
  j["max_plastic_strain"] = r.max_plastic_strain;
  j["max_lag"] = r.report.max_lag;
  const auto& errors = r.report.errors;
  j["estimated_error_lag"] = errors.lag;
  j["estimated_error_time"] = errors.time;
  j["estimated_error_penetration"] = errors.penetration;
  if (options.mesh_error_interval > 0)
    j["estimated_error_space"] = errors.space;
  else
    j["estimated_error_space"] = nullptr;
  j["final_force_N"] = r.force_N.back();
  if (r.energies) {
    const auto& e = *r.energies;
    constexpr double joule = 1e-3;  // a N mm
    j["kinetic_energy_J"] = e.kinetic * joule;
    j["plastic_work_J"] = e.plastic * joule;
    j["friction_work_J"] = e.friction * joule;
    j["external_work_J"] = e.external * joule;
    j["elastic_energy_J"] = e.elastic * joule;
    j["penalty_energy_J"] = e.penalty * joule;
    j["algorithmic_work_J"] = e.algorithmic * joule;
    j["unbalanced_work_J"] = e.unbalanced() * joule;
  }
  if (r.checks_self_penetration) {
    if (r.self_penetration_mm)
      j["self_penetration_from_mm"] = *r.self_penetration_mm;
    else
      j["self_penetration_from_mm"] = nullptr;
    j["deepest_in_itself_mm"] = r.deepest_in_itself_mm;
  }
  if (!r.advice.empty()) j["advice"] = r.advice;
  j["warnings"] = nlohmann::ordered_json::array();
  for (const auto& w : r.warnings)
    j["warnings"].push_back({{"name", w.name}, {"text", w.text}, {"step", w.step}, {"count", w.count}});
  j["history"] = {{"time_s", r.time_s}, {"displacement_mm", r.travel_mm}, {"force_N", r.force_N}};
  return j;
}

void write_history(const std::filesystem::path& path, const Record& r) {
  stickslip::io::NewFile file(path);
  std::ostream& csv = file.stream();
  csv.precision(12);
  csv << "step,time_s,displacement_mm,force_N,dt_s,iterations,rejected,residual,nodes_in_contact,nodes_sliding,max_"
         "penetration_mm,max_slip_mm,lag,error_lag,error_time,error_penetration,error_space,negative_pivots\n"
      << "0," << r.time_s[0] << ',' << r.travel_mm[0] << ',' << r.force_N[0] << ",0,0,0,0,0,0,0,0,0,0,0,0,0,0\n";
  for (std::size_t i = 0; i < r.steps.size(); ++i) {
    const auto& s = r.steps[i];
    csv << s.number << ',' << r.time_s[i + 1] << ',' << r.travel_mm[i + 1] << ',' << r.force_N[i + 1] << ',' << s.dt
        << ',' << s.iterations << ',' << s.rejected << ',' << s.residual << ',' << s.contact.touching << ','
        << s.contact.sliding << ',' << s.contact.max_penetration << ',' << s.contact.max_slip << ',' << s.lag << ','
        << s.errors.lag << ',' << s.errors.time << ',' << s.errors.penetration << ',' << s.errors.space << ','
        << s.negative_pivots << '\n';
  }
  file.place();
}

void draw_results(const Options& options, const Record& r) {
  const std::string title = r.labels.name + ", " + options.friction + ", mu = " + fixed(options.mu, 2);
  draw(options.output, "force",
       "set datafile separator ','\nset title '" + title + "'\nset xlabel '" + r.labels.travel +
           " [mm]'\nset ylabel '" + r.labels.force +
           " [kN]'\nset grid\nset key off\nplot 'history.csv' every ::1 using 3:($4/1000) with linespoints pt 7 ps 0.5 "
           "lw 2");
  draw(options.output, "mesh",
       "set title '" + title + ": deformed mesh at " + fixed(r.travel_mm.back(), 1) +
           " mm'\nset view map\nset size ratio -1\nset key off\nset cblabel 'plastic strain'\nset palette defined (0 "
           "'#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')\nset xlabel 'r [mm]'\nset ylabel 'z [mm]'\n"
           "set pm3d corners2color c1 border lc rgb '#404040' lw 0.4\n" +
           r.labels.view +
           "\nsplot 'mesh.dat' using 1:2:3 with pm3d, 'tools.dat' using 1:2:(0) with lines lc rgb 'black' lw 2");
}

}  // namespace

void Record::serialize(stickslip::Archive& archive) {
  archive.resizable("history, time", time_s);
  archive.resizable("history, travel", travel_mm);
  archive.resizable("history, force", force_N);
  archive.resizable("history, steps", steps);
  archive("history, seconds", seconds);
  std::vector<double> penetrates;
  if (self_penetration_mm) penetrates.push_back(*self_penetration_mm);
  archive.resizable("history, self-penetration", penetrates);
  archive("history, deepest in itself", deepest_in_itself_mm);
  if (!archive.loading()) return;
  if (time_s.size() != steps.size() + 1 || travel_mm.size() != time_s.size() || force_N.size() != time_s.size())
    throw std::runtime_error(archive.origin + " does not fit: its histories are not of one length");
  self_penetration_mm.reset();
  if (!penetrates.empty()) self_penetration_mm = penetrates[0];
}

std::string shot_name(double travel_mm) {
  return "mesh_" + fixed(travel_mm, 1) + ".dat";
}

void draw(const std::filesystem::path& directory, const std::string& name, const std::string& body, int width,
          int height) {
  const auto script = directory / (name + ".gp");
  stickslip::io::write_file(script, [&](std::ostream& out) {
    for (const std::string kind : {"pngcairo", "svg"})
      out << "set terminal " << kind << " size " << width << ',' << height
          << " noenhanced background rgb 'white' font 'sans,12'\nset output '" << name
          << (kind == "svg" ? ".svg" : ".png") << "'\n"
          << body << "\nunset output\n";
  });
  // The folder is reached as the working directory, so that no part of its name is read by a shell.
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(directory);
  const int status = std::system(("gnuplot " + name + ".gp > " + name + ".log 2>&1").c_str());
  std::filesystem::current_path(here);
  const std::string log = name + ".log";
  if (status != 0) {
    for (const char* torn : {".png", ".svg"}) std::filesystem::remove(directory / (name + torn));
    throw std::runtime_error("gnuplot could not draw " + (directory / name).string() +
                             "; is the package gnuplot-nox installed? Its words are in " + log);
  }
  std::filesystem::remove(directory / log);
}

void show_progress(const Options& options, const Record& r, double fraction) {
  if (on_terminal(options))
    std::fprintf(stderr, "\r%s: %3.0f %%  step %d  travel %.3f mm  force %.0f N   ", r.labels.name.c_str(),
                 100 * fraction, r.steps.back().number, r.travel_mm.back(), r.force_N.back());
}

void end_progress(const Options& options) {
  if (on_terminal(options)) std::fputc('\n', stderr);
}

int conclude(const Options& options, const Record& r, Outputs& outputs) {
  if (!options.output.empty()) {
    outputs.attempt([&] { write_history(options.output / "history.csv", r); });
    outputs.attempt([&] { draw_results(options, r); });
  }
  if (!options.json.empty())
    outputs.attempt([&] {
      auto json = to_json(options, r);
      if (!outputs.missing().empty()) json["files_missing"] = outputs.missing();
      const std::string text = json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
      if (options.json == "-") return write_to_standard_output(text);
      stickslip::io::NewFile file(options.json, stickslip::io::Target::any);
      file.write(text);
      file.place();
    });
  if (!options.quiet && options.json != "-")
    std::printf(
        "%s %s mu %.2f %s: %d steps, %d iterations, %d rejected; %.1f mm, %.0f N; penetration %.4g mm, slip %.4g mm, "
        "lag %.3g; %.1f ms\n  estimated errors: lag %.2g %%, steps %.2g %%, penetration %.2g %%, mesh %.2g %%\n",
        r.labels.name.c_str(), options.friction.c_str(), options.mu, options.solver.c_str(), r.report.steps,
        r.report.iterations, r.report.rejected_steps, r.travel_mm.back(), r.force_N.back(), r.report.max_penetration,
        r.report.max_slip, r.report.max_lag, 1e3 * r.seconds, 100 * r.report.errors.lag, 100 * r.report.errors.time,
        100 * r.report.errors.penetration, 100 * r.report.errors.space);
  if (!r.advice.empty() && options.json != "-") std::printf("%s\n", r.advice.c_str());
  if (!options.quiet && r.self_penetration_mm)
    std::fprintf(stderr, "%s: from %.1f mm on the body passes through itself\n", r.labels.name.c_str(),
                 *r.self_penetration_mm);
  if (outputs.missing().size() > 1)
    std::cerr << r.labels.name << ": " << outputs.missing().size() << " files could not be written\n";
  for (const auto& w : r.warnings)
    std::cerr << r.labels.name << ": warning: " << w.text
              << (w.count > 1 ? " (" + std::to_string(w.count) + " times)" : "") << '\n';
  if (!r.outcome) std::cerr << r.labels.name << ": " << r.outcome.message() << '\n';
  return !r.outcome ? 1 : outputs.missing().empty() ? 0 : output_missing;
}

}  // namespace examples
