#pragma once

#include "tests/unit/shared/scratch_folder.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <regex>
#include <sstream>
#include <thread>

namespace spall::test {

/// Returns a list of words with more words appended.
inline std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// A run of the program penetrate as a process, in its own folder.
class Program {
public:
  Program() : output(folder / "out") {}

  /// Starts the program with the arguments and `--output`.
  void start(std::vector<std::string> words) {
    words.insert(words.end(), {"--output", output.string()});
    start_without_output(std::move(words));
  }
  void start_without_output(std::vector<std::string> words) {
    words.insert(words.begin(), PENETRATE);
    if (processes > 1)
      words.insert(words.begin(), {"mpirun", "--oversubscribe", "-n", std::to_string(processes)});
    words.emplace_back("Run/Threads=1");
    child = fork();
    if (child == 0) {
      if (largest_file > 0) {
        const rlimit limit{largest_file, largest_file};
        setrlimit(RLIMIT_FSIZE, &limit);
      }
      if (stdout_closed)
        close(1);
      else
        redirect(full_stdout ? "/dev/full" : "stdout", 1);
      redirect("stderr", 2);
      if (!directory.empty() && chdir(directory.c_str()) != 0) _exit(126);
      std::vector<char*> argv;
      for (std::string& word : words) argv.push_back(word.data());
      argv.push_back(nullptr);
      for (const char* name :
           {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_mpi_yield_when_idle"})
        setenv(name, "1", 1);
      execvp(argv[0], argv.data());
      _exit(127);
    }
  }
  /// Waits for the end of the program and returns the exit code, or minus the signal that ended it.
  int wait() const {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  int run(std::vector<std::string> words) {
    start(std::move(words));
    return wait();
  }
  int run_without_output(std::vector<std::string> words) {
    start_without_output(std::move(words));
    return wait();
  }
  /// Sends a signal to one of its processes, of several.
  void send_to_one(int signal) const {
    std::vector<pid_t> ranks;
    for (const auto& thread :
         std::filesystem::directory_iterator("/proc/" + std::to_string(child) + "/task")) {
      std::ifstream list(thread.path() / "children");
      for (pid_t one = 0; list >> one;) ranks.push_back(one);
    }
    ASSERT_EQ(ranks.size(), static_cast<std::size_t>(processes));
    kill(ranks.back(), signal);
  }
  void interrupt() const { send(SIGINT); }
  void send(int signal) const { kill(child, signal); }

  std::string text(const std::string& name) const { return read_text(folder / name); }
  std::size_t lines(const std::string& name) const {
    const std::string all = text(name);
    return static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n'));
  }
  /// Contents and times of all files below the folder of the results.
  std::map<std::string, std::pair<std::string, std::filesystem::file_time_type>> results() const {
    std::map<std::string, std::pair<std::string, std::filesystem::file_time_type>> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(output))
      if (entry.is_regular_file())
        all[entry.path().string()] = {read_text(entry.path()), entry.last_write_time()};
    return all;
  }
  /// Runs it, and expects that it refuses in one line with all of `message` and changes nothing on the disk.
  void expect_refused(const std::vector<std::string>& words, const std::vector<std::string>& message) {
    const bool there = std::filesystem::exists(output);
    const auto before =
        there ? results() : std::map<std::string, std::pair<std::string, std::filesystem::file_time_type>>{};
    EXPECT_EQ(run(words), 2) << words.back();
    EXPECT_EQ(lines("stderr"), 1u) << text("stderr");
    for (const std::string& word : message)
      EXPECT_NE(text("stderr").find(word), std::string::npos) << word << " in: " << text("stderr");
    EXPECT_EQ(std::filesystem::exists(output), there);
    if (there) {
      EXPECT_TRUE(results() == before) << words.back();
    }
  }
  /// Lets it run until history.csv has `count` lines.
  void wait_for_history(std::size_t count) const {
    for (int n = 0; n < 4000 && lines("out/history.csv") < count; ++n)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }

  /// summary.json as texts by key. It is flat: a key and a value per line.
  std::map<std::string, std::string> summary() const {
    std::map<std::string, std::string> entries;
    const std::string all = text("out/summary.json");
    const std::regex entry("\"([^\"]+)\": (.*?),?\n");
    for (std::sregex_iterator m(all.begin(), all.end(), entry), end; m != end; ++m)
      entries[(*m)[1]] = (*m)[2];
    return entries;
  }
  /// Returns the first line and the rows of history.csv.
  std::pair<std::vector<std::string>, std::vector<std::vector<double>>> history() const {
    std::ifstream stream(output / "history.csv");
    std::vector<std::string> names;
    std::vector<std::vector<double>> rows;
    std::string line, cell;
    std::getline(stream, line);
    for (std::stringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
    while (std::getline(stream, line)) {
      rows.emplace_back();
      for (std::stringstream cells(line); std::getline(cells, cell, ',');)
        rows.back().push_back(std::stod(cell));
    }
    return {names, rows};
  }

  ScratchFolder folder;
  std::filesystem::path output;
  std::filesystem::path directory{}; ///< that it starts in; empty: that of the test
  bool full_stdout = false, stdout_closed = false;
  int processes = 1;            ///< that mpirun starts, if more than one
  std::size_t largest_file = 0; ///< that it may write, bytes; 0: no limit

private:
  void redirect(const char* name, int descriptor) const {
    const int file = open((folder.path / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    dup2(file, descriptor);
  }
  pid_t child = -1;
};

} // namespace spall::test
