#include "cluster/slurm.h"

#include "base/directory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/// A file of the directory: `%1$s` is the program, `%2$d` the number of parts.
typedef struct script {
    const char* name;
    const char* text;
} script;

#define WRITTEN "# Written by `bolter campaign --slurm`; edit it as your cluster wants it.\n"

static const script scripts[] = {
    {"landings.sh",
     "#!/bin/sh\n" WRITTEN
     "# The landings of the study, in parts: one task of the array runs one of them. A task that\n"
     "# was killed or preempted goes on where it stopped when Slurm starts it again.\n"
     "#SBATCH --job-name=bolter-landings\n"
     "#SBATCH --array=1-%2$d\n"
     "#SBATCH --cpus-per-task=1\n"
     "#SBATCH --time=12:00:00\n"
     "#SBATCH --requeue\n"
     "#SBATCH --open-mode=append\n"
     "#SBATCH --output=landings-%%a.log\n"
     "# two minutes before the time is over, so that the task ends in order and is queued again\n"
     "#SBATCH --signal=B:USR1@120\n"
     "bolter='%1$s'\n"
     "parts=%2$d # as many as the array has tasks; part-*/ belong to this number\n"
     "\n"
     "\"$bolter\" campaign study.yaml --shard \"$SLURM_ARRAY_TASK_ID/$parts\" \\\n"
     "    -o \"part-$SLURM_ARRAY_TASK_ID\" --quiet &\n"
     "work=$!\n"
     "again=no\n"
     "trap 'again=yes; kill -USR1 $work' USR1\n"
     "trap 'kill -TERM $work' TERM INT\n"
     "code=0\n"
     "wait $work || code=$?\n"
     "# a signal ends the first wait, not the work\n"
     "while kill -0 $work 2>/dev/null; do code=0; wait $work || code=$?; done\n"
     "if [ $again = yes ] && [ $code -ne 0 ]; then\n"
     "    scontrol requeue \"${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID\"\n"
     "fi\n"
     "exit $code\n"},
    {"results.sh",
     "#!/bin/sh\n" WRITTEN "# Puts the parts together; then everything else of the study: landings "
     "that are missing, the\n"
     "# classifier, the reliability of every condition.\n"
     "#SBATCH --job-name=bolter-results\n"
     "#SBATCH --cpus-per-task=1\n"
     "#SBATCH --time=02:00:00\n"
     "#SBATCH --requeue\n"
     "#SBATCH --open-mode=append\n"
     "#SBATCH --output=results.log\n"
     "set -eu\n"
     "bolter='%1$s'\n"
     "\n"
     "\"$bolter\" campaign merge study.yaml part-*/campaign.sqlite -o results --quiet\n"
     "\"$bolter\" study study.yaml -o results --quiet\n"},
    {"submit.sh",
     "#!/bin/sh\n" WRITTEN
     "# Submits the landings, and the results for when all of them are there. To go on after a\n"
     "# cancel, submit again: nothing is run twice.\n"
     "set -eu\n"
     "cd \"$(dirname \"$0\")\"\n"
     "landings=$(sbatch --parsable landings.sh)\n"
     "results=$(sbatch --parsable --dependency=\"afterok:$landings\" results.sh)\n"
     "echo \"landings: job $landings; results: job $results, in results/\"\n"},
};
enum { SCRIPT_COUNT = sizeof scripts / sizeof scripts[0] };

static bt_status write_text(const char* directory, const char* name, const char* text,
                            bt_diag* diag) {
    char path[BT_FILE_PATH_MAX];
    BT_TRY(bt_file_path(path, directory, name));
    return bt_file_write(path, text, strlen(text), diag);
}

static bt_status write_script(const char* directory, const script* s, const char* program,
                              int parts, bt_diag* diag) {
    char path[BT_FILE_PATH_MAX], *text = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return BT_ERR_MEMORY;
    fprintf(out, s->text, program, parts);
    bt_status status = fclose(out) == 0 ? BT_OK : BT_ERR_MEMORY;
    if (status == BT_OK)
        status = write_text(directory, s->name, text, diag);
    free(text);
    BT_TRY(status);
    BT_TRY(bt_file_path(path, directory, s->name));
    if (chmod(path, 0755) == 0)
        return BT_OK;
    bt_diag_add(diag, BT_ERROR, (bt_where){.file = path}, "cannot be made executable");
    return BT_ERR_IO;
}

/// Scripts that are there may have been edited.
static bt_status refuse_present(const char* directory, bt_diag* diag) {
    char path[BT_FILE_PATH_MAX];
    for (int i = 0; i < SCRIPT_COUNT; ++i) {
        BT_TRY(bt_file_path(path, directory, scripts[i].name));
        if (access(path, F_OK) != 0)
            continue;
        bt_diag_add(diag, BT_ERROR, (bt_where){.file = path},
                    "is there already and may have been edited; remove it, or name another "
                    "directory");
        return BT_ERR_IO;
    }
    return BT_OK;
}

/// The study as it was read, --set and all, under a first line that says whose file it is.
static bt_status write_study(const bt_study* study, const char* directory, bt_diag* diag) {
    static const char mark[] = "# The study of these jobs, as Bolter read it.\n";
    const size_t size = sizeof mark + strlen(study->text);
    char* text = malloc(size);
    if (!text)
        return BT_ERR_MEMORY;
    snprintf(text, size, "%s%s", mark, study->text);
    const bt_status status = write_text(directory, "study.yaml", text, diag);
    free(text);
    return status;
}

bt_status bt_slurm_write(const bt_study* study, const char* directory, const char* program,
                         int parts, bt_diag* diag) {
    if (study->campaign.design == BT_DESIGN_CONDITIONS && study->campaign.unsure > 0) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                    "--slurm: the rounds of design conditions need the landings of all parts; set "
                    "campaign.unsure to 0, or run one job with mpirun");
        return BT_ERR_INPUT;
    }
    if (strchr(program, '\'')) {
        bt_diag_add(diag, BT_ERROR, BT_NOWHERE, "--slurm: the program's path has a quote: %s",
                    program);
        return BT_ERR_INPUT;
    }
    BT_TRY(bt_directory_make(directory, diag));
    BT_TRY(refuse_present(directory, diag));
    BT_TRY(write_study(study, directory, diag));
    for (int i = 0; i < SCRIPT_COUNT; ++i)
        BT_TRY(write_script(directory, &scripts[i], program, parts, diag));
    return BT_OK;
}
