/* A process of the bench that is started by `bench serve FOLDER`, and the messages between it and the host's process.
 *
 * A message is one byte, the length of its content as eight bytes, and the content; numbers lie as in memory: both ends are on
 * one machine. The pipe is a pair of sockets without a name, since writing to one whose reader has gone raises no signal in the
 * host. Standard error of the process is a file without a name; its last line says why the process ended.
 */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#define LONGEST_TEXT 1024
#define MOST_WORDS 32 /* of the command */

extern char **environ;

typedef struct {
    pid_t pid; /* 0: it has ended */
    int link;
    FILE *errors;
    char said[LONGEST_TEXT]; /* why the last call failed */
    char answer;             /* kind of the last message that came */
    unsigned char *content;
    uint64_t length;
} BenchProcess;

/* The last line on standard error of a process that has ended, or how it ended. */
static void bench_last_line(BenchProcess *bench, int status) {
    char line[LONGEST_TEXT - 64], last[LONGEST_TEXT - 64] = "";
    rewind(bench->errors);
    while (fgets(line, sizeof line, bench->errors)) {
        line[strcspn(line, "\r\n")] = '\0';
        if (line[strspn(line, " \t")])
            memcpy(last, line, sizeof last);
    }
    if (last[0])
        snprintf(bench->said, sizeof bench->said, "the process of the bench has ended: %s", last);
    else if (WIFSIGNALED(status))
        snprintf(bench->said, sizeof bench->said, "the process of the bench has ended by signal %d", WTERMSIG(status));
    else
        snprintf(bench->said, sizeof bench->said, "the process of the bench has ended with status %d", WEXITSTATUS(status));
}

/* Its link has broken: it is ending. Says why, and returns 0. */
static int bench_gone(BenchProcess *bench) {
    int status = 0;
    if (!bench->pid) /* said before */
        return 0;
    shutdown(bench->link, SHUT_RDWR);
    while (waitpid(bench->pid, &status, 0) < 0 && errno == EINTR)
        ;
    bench->pid = 0;
    bench_last_line(bench, status);
    return 0;
}

/* Send parts as one: each call would wake the process. */
static int bench_send(BenchProcess *bench, struct iovec *parts, size_t count) {
    while (count) {
        struct msghdr message = {.msg_iov = parts, .msg_iovlen = count};
        ssize_t sent = sendmsg(bench->link, &message, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent < 0)
            return 0;
        for (; count && (size_t)sent >= parts->iov_len; parts++, count--)
            sent -= (ssize_t)parts->iov_len;
        if (count) {
            parts->iov_base = (char *)parts->iov_base + sent;
            parts->iov_len -= (size_t)sent;
        }
    }
    return 1;
}

static int bench_receive(BenchProcess *bench, void *data, uint64_t length) {
    char *place = data;
    while (length) {
        ssize_t received = recv(bench->link, place, length, 0);
        if (received < 0 && errno == EINTR)
            continue;
        if (received <= 0)
            return 0;
        place += received;
        length -= (uint64_t)received;
    }
    return 1;
}

/* Wait for a message. 1: it came, and `answer`, `content`, `length` hold it; 0: `said` holds a sentence. */
static int bench_answer(BenchProcess *bench) {
    uint64_t length;
    unsigned char *content;
    if (!bench_receive(bench, &bench->answer, 1) || !bench_receive(bench, &length, sizeof length))
        return bench_gone(bench);
    content = realloc(bench->content, length + 1);
    if (!content) {
        snprintf(bench->said, sizeof bench->said, "no memory for an answer of %llu bytes", (unsigned long long)length);
        kill(bench->pid, SIGKILL); /* the rest of its answer cannot be read */
        return bench_gone(bench);
    }
    bench->content = content;
    bench->length = length;
    if (!bench_receive(bench, content, length))
        return bench_gone(bench);
    content[length] = '\0';
    if (bench->answer == 'e') {
        snprintf(bench->said, sizeof bench->said, "%s", (char *)content);
        return 0;
    }
    return 1;
}

/* Ask, and wait for the answer, as `bench_answer`. The question is two parts behind each other. */
static int bench_ask(BenchProcess *bench, char kind, const void *first, uint64_t length, const void *second, uint64_t more) {
    char header[9] = {kind};
    uint64_t whole = length + more;
    struct iovec parts[] = {{header, sizeof header}, {(void *)first, length}, {(void *)second, more}};
    if (!bench->pid)
        return 0;
    memcpy(header + 1, &whole, sizeof whole);
    if (!bench_send(bench, parts, 3))
        return bench_gone(bench);
    return bench_answer(bench);
}

/* The words of the command in a file, one a line, behind each other in `text`; their number, 0 where there is none. */
static int bench_words(const char *folder, char *text, size_t size, char **words) {
    char path[4096];
    FILE *file;
    size_t length;
    int count = 0;
    snprintf(path, sizeof path, "%s/command", folder);
    file = fopen(path, "r");
    if (!file)
        return 0;
    length = fread(text, 1, size - 1, file);
    fclose(file);
    text[length] = '\0';
    for (char *word = strtok(text, "\n"); word && count < MOST_WORDS; word = strtok(NULL, "\n"))
        words[count++] = word;
    return count;
}

/* Start the process, and wait for its first message. 0: `said` holds a sentence. To be ended by `bench_end` in any case. */
static int bench_start(BenchProcess *bench, const char *folder) {
    char text[16384], *words[MOST_WORDS + 3], *own = getenv("CONTACT_BENCH_COMMAND");
    int ends[2], count = 0, failure;
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, pipe_signal;

    memset(bench, 0, sizeof *bench);
    bench->link = -1;
    if (own && own[0])
        words[count++] = own;
    else if (!(count = bench_words(folder, text, sizeof text, words))) {
        snprintf(bench->said, sizeof bench->said, "%.500s/command cannot be read: the FMU is not whole", folder);
        return 0;
    }
    words[count++] = "serve";
    words[count++] = (char *)folder;
    words[count] = NULL;
    bench->errors = tmpfile();
    if (!bench->errors || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends)) {
        snprintf(bench->said, sizeof bench->said, "the bench cannot be started: %s", strerror(errno));
        return 0;
    }
    fcntl(fileno(bench->errors), F_SETFD, FD_CLOEXEC);

    /* in a group of its own, so that a Ctrl-C for the host is not one for it; it ends when the host does, by its pipe */
    sigemptyset(&none);
    sigemptyset(&pipe_signal);
    sigaddset(&pipe_signal, SIGPIPE);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &pipe_signal);
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 0);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
    posix_spawn_file_actions_adddup2(&actions, fileno(bench->errors), 2);
    failure = posix_spawnp(&bench->pid, words[0], &actions, &attributes, words, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    close(ends[1]);
    bench->link = ends[0];
    if (failure) {
        bench->pid = 0;
        snprintf(bench->said, sizeof bench->said, "%.500s cannot be started: %s", words[0], strerror(failure));
        return 0;
    }
    return bench_answer(bench);
}

/* End the process, and release what it held. */
static void bench_end(BenchProcess *bench) {
    if (bench->link >= 0) {
        if (bench->pid)
            bench_gone(bench); /* it ends at the end of its pipe */
        close(bench->link);
    }
    if (bench->errors)
        fclose(bench->errors);
    free(bench->content);
    memset(bench, 0, sizeof *bench);
    bench->link = -1;
}
