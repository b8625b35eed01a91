"""Whether figures are older than the code that they speak of."""
import subprocess

from evidence.common import ROOT

CHANGES = "changes figures"  # in the message of a commit after which everything is to be measured again


def git(*command, root=ROOT):
    """(status, what it prints)"""
    try:
        run = subprocess.run(["git", "-C", str(root), *command], capture_output=True, text=True)
    except FileNotFoundError:
        return 127, ""
    return run.returncode, run.stdout.strip()


def no_history(root=ROOT):
    """Why the history cannot be asked; empty where it can."""
    status, shallow = git("rev-parse", "--is-shallow-repository", root=root)
    if status:
        return "no git history"
    return "a shallow clone" if shallow == "true" else ""


def before(older, newer, root=ROOT):
    """Whether `older` is an ancestor of `newer`, and another commit; False where one of them is not there."""
    same = git("rev-parse", f"{older}^{{commit}}", root=root) == git("rev-parse", f"{newer}^{{commit}}", root=root)
    return not same and git("merge-base", "--is-ancestor", older, newer, root=root)[0] == 0


def stale(document, file, root=ROOT):
    """A line for each reason why the figures in `file` are older than the last commit that changed figures."""
    _, change = git("log", "-1", "--format=%H", "--fixed-strings", f"--grep={CHANGES}", root=root)
    if not change:
        return []
    reasons = []
    _, written = git("log", "-1", "--format=%H", "--", str(file), root=root)
    waits = git("status", "--porcelain", "--", str(file), root=root)[1]
    if not waits and (not written or before(written, change, root)):
        reasons.append(f"{file} was written before {change[:7]}, which {CHANGES}")
    for part, entry in document.items():
        flown_by = entry.get("commit", "").split(" ")[0]
        if flown_by and before(flown_by, change, root):
            reasons.append(f"{part} was flown by {flown_by}, before {change[:7]}, which {CHANGES}")
    return reasons
