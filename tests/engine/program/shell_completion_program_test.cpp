// Completion in real shells: keys are typed into a pseudo-terminal, and the words that the shell then passes
// to the program are compared. Skipped for shells that are not installed.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <ostream>
#include <string>
#include <thread>

#include "tests/engine/program/program.h"
#include "tests/engine/program/terminal_shell.h"

namespace tessera::shell_completion_program_test {
namespace {

namespace fs = std::filesystem;

struct Shell {
  const char* name;
  TerminalShell::Words words;  ///< starts it without the user's settings
  const char* setup;           ///< command that loads the completion
};

const Shell kShells[] = {
    {"bash", {"bash", "--norc", "--noprofile", "-i"}, "PS1='re''ady> '; source completion.bash"},
    {"zsh",
     {"zsh", "-f", "-i"},
     "autoload -U compinit; compinit -u -D; PROMPT='re''ady> '; source completion.zsh"},
    {"fish",
     {"fish", "--no-config", "-i"},
     "function fish_prompt; echo -n 're''ady> '; end; function fish_right_prompt; end; source "
     "completion.fish"},
};

void PrintTo(const Shell& shell, std::ostream* stream) { *stream << shell.name; }

/// Shells may attach values by "=", and may end a folder's name with "/".
std::string normal(const std::string& words) {
  std::string text;
  for (const char c : words)
    if (c == '=') text += "][";
    else if (c == ']' && text.ends_with('/')) text.back() = c;
    else text += c;
  return text;
}

/// A folder with files, and a program `tessera` on the path that notes its arguments. Completions that ask
/// the program for names get them from the tested one.
class ShellCompletion : public Program, public testing::WithParamInterface<Shell> {
 protected:
  ShellCompletion() {
    const std::string shell = GetParam().name;
    write("completion." + shell, run("completion " + shell).out);
    write("my scene.json", "");
    write("your.json", "");
    fs::create_directories(folder_ / "out folder");
    fs::create_directories(folder_ / "bin");
    write("bin/tessera", "#!/bin/sh\n[ \"$2\" = --list ] && exec '" TESSERA_PROGRAM
                         "' \"$@\"\nprintf '[%s]' \"$@\" >typed.new\n"
                         "mv typed.new typed.txt\n");
    fs::permissions(folder_ / "bin/tessera", fs::perms::owner_all);
  }

  bool is_installed() const {
    return std::system((std::string("command -v ") + GetParam().name + " >/dev/null 2>&1").c_str()) == 0;
  }
  TerminalShell::Words environment() const {
    return {"PATH=" + (folder_ / "bin").string() + ":" + std::getenv("PATH"),
            "TERM=xterm",
            "HOME=" + folder_.string(),
            "XDG_CONFIG_HOME=" + folder_.string(),
            "XDG_DATA_HOME=" + folder_.string(),
            "LC_ALL=C.UTF-8",
            "HISTFILE="};
  }
  /// Waits until the program has noted its arguments.
  std::string typed_words() const {
    for (int tenths = 0; tenths < 600 && !exists("typed.txt"); ++tenths)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const std::string words = content("typed.txt");
    fs::remove(folder_ / "typed.txt");
    return words;
  }
};

TEST_P(ShellCompletion, CompletesWhatIsTyped) {
  if (!is_installed()) GTEST_SKIP() << "no " << GetParam().name;
  TerminalShell shell(GetParam().words, environment(), folder_.string());
  shell.type(std::string(GetParam().setup) + "\r");
  ASSERT_TRUE(shell.wait_for("ready> ")) << shell.screen();
  const struct {
    const char* keys;
    const char* words;
  } kRows[] = {
      {"tessera sel\t", "[selftest]"},
      {"tessera render --thres\t5", "[render][--threshold][5]"},
      {"tessera render --shading g\t", "[render][--shading][gouraud]"},
      {"tessera render --mode vga1\t3\t", "[render][--mode][vga13h]"},
      {"tessera render --display trini\t", "[render][--display][trinitron17]"},
      {"tessera render --stats=j\t", "[render][--stats=json]"},
      {"tessera render my\t", "[render][my scene.json]"},
      {"tessera render --compare yo\t", "[render][--compare][your.json]"},
      {"tessera render -o my\t", "[render][-o][my scene.json]"},
      {"tessera modes --modes cga,amiga-\t", "[modes][--modes][cga,amiga-ntsc]"},
      {"tessera modes yo\t -o ou\t", "[modes][your.json][-o][out folder/]"},
      {"tessera color 1 1 1 --to okl\t", "[color][1][1][1][--to][oklab]"},
      {"tessera completion f\t", "[completion][fish]"},
      {"tessera help expl\t", "[help][explain]"},
      {"tessera bench fill-gour\t", "[bench][fill-gouraud]"},
      {"tessera bench --comp\tyo\t", "[bench][--compare][your.json]"},
      {"tessera accuracy --qui\t", "[accuracy][--quick]"},
  };
  for (const auto& [keys, words] : kRows) {
    shell.type(std::string(keys) + "\r");
    EXPECT_EQ(normal(typed_words()), normal(words)) << GetParam().name << ": " << keys << "\n"
                                                    << shell.screen();
    ASSERT_TRUE(shell.wait_for("ready> ")) << shell.screen();
  }
}

INSTANTIATE_TEST_SUITE_P(Shells, ShellCompletion, testing::ValuesIn(kShells),
                         [](const testing::TestParamInfo<Shell>& shell) { return shell.param.name; });

}  // namespace
}  // namespace tessera::shell_completion_program_test
#endif
