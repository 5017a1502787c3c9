#pragma once

#include "tests/unit/shared/scratch_folder.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <regex>
#include <sstream>

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
    words.insert(words.begin(), PENETRATE);
    if (processes > 1)
      words.insert(words.begin(), {"mpirun", "--oversubscribe", "-n", std::to_string(processes)});
    words.insert(words.end(), {"--output", output.string(), "Run/Threads=1"});
    child = fork();
    if (child == 0) {
      if (largest_file > 0) {
        const rlimit limit{largest_file, largest_file};
        setrlimit(RLIMIT_FSIZE, &limit);
      }
      redirect("stdout", 1);
      redirect("stderr", 2);
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
  /// Sends a signal to one of the program's several processes.
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
  /// Returns the values of summary.json as texts by key. The file is flat, with one key and value per line.
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
  int processes = 1;            ///< number of processes; several are started by mpirun
  std::size_t largest_file = 0; ///< largest file that the program may write, bytes; 0: no limit

private:
  void redirect(const char* name, int descriptor) const {
    const int file = open((folder / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    dup2(file, descriptor);
  }
  pid_t child = -1;
};

} // namespace spall::test
