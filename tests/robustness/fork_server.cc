// Runs a program many times without loading it each time, which takes longer than most of the cases: its
// libraries are many. For each line on standard input, the name of a request, a copy of this process works in
// the folder of the request as if it had just been started; then a line says how it ended. The first one says
// which process it is.
//
// A request holds texts that end with NUL: folder, files for standard output and error, bytes of memory, the
// command line.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

int program_main(int argc, char** argv); // the program's own

namespace {

std::vector<std::string> texts_of(const std::string& request) {
  std::vector<std::string> texts;
  std::ifstream file(request, std::ios::binary);
  for (std::string text; std::getline(file, text, '\0');) texts.push_back(text);
  return texts;
}

void redirect(const std::string& file, int flags, int descriptor) {
  const int opened = open(file.c_str(), flags, 0644);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
  close(opened);
}

[[noreturn]] void work(std::vector<std::string> texts) {
  if (texts.size() < 5 || chdir(texts[0].c_str()) != 0) _exit(126);
  redirect("/dev/null", O_RDONLY, 0);
  redirect(texts[1], O_WRONLY | O_CREAT, 1);
  redirect(texts[2], O_WRONLY | O_CREAT, 2);
  const rlimit memory{std::stoull(texts[3]), std::stoull(texts[3])};
  setrlimit(RLIMIT_AS, &memory);
  std::vector<char*> arguments;
  for (std::size_t i = 4; i < texts.size(); ++i) arguments.push_back(texts[i].data());
  const int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  std::exit(program_main(count, arguments.data()));
}

} // namespace

int main() {
  for (std::string request; std::getline(std::cin, request);) {
    const pid_t child = fork();
    if (child == 0) work(texts_of(request));
    std::printf("%d\n", static_cast<int>(child));
    std::fflush(stdout);
    int status = 0;
    waitpid(child, &status, 0);
    std::printf("%d\n", WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status));
    std::fflush(stdout);
  }
}
