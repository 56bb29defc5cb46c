"""Many surfaces on Dask's workers: each is done once, and only what is missing. Not for clinical decisions.

    python many.py SURFACES RESULTS [NAME=VALUE...]

takes the surfaces in the folder SURFACES; NAME=VALUE are settings, such as reduction=90. On many machines give Dask's
scheduler by its address in DASK_SCHEDULER_ADDRESS; then all of them see both folders.

A result is called by the SHA-256 of what makes it: the file's bytes, the settings and the version. Of one surface come KEY.stl
and then KEY.json, the report; where that is, nothing is left to do.
"""
import hashlib
import json
import os
import sys
import uuid
from pathlib import Path

import lumen
from dask.distributed import Client, as_completed, wait

ENDINGS = {".stl", ".ply", ".obj", ".vtp", ".vtk", ".glb"}


def key(path, settings):
    """What the result of a file is called."""
    digest = hashlib.sha256(Path(path).read_bytes())
    digest.update(json.dumps([settings, lumen.__version__], sort_keys=True).encode())
    return digest.hexdigest()


def optimise(path, results, name, settings):
    """Makes one result, where it is not there yet; whether it had to."""
    report = Path(results, f"{name}.json")
    if report.exists():
        return False
    made = lumen.read(path).optimise(settings)
    made.reduced.save(report.with_suffix(".stl"))
    # Two machines can have processes of one number.
    part = report.with_suffix(f".{uuid.uuid4().hex}.part")
    with part.open("x") as file:
        json.dump(made.report, file)
    # The report is there whole and last: it says that the result is.
    part.replace(report)
    return True


def run(client, surfaces, results, **named):
    """Does what is missing; the files by the key of their result, the keys that were made, and the errors by file.

    A file that cannot be read has an error and no key."""
    settings = lumen.settings(**named)
    paths = sorted(str(path.resolve()) for path in Path(surfaces).iterdir() if path.suffix.lower() in ENDINGS)
    Path(results).mkdir(parents=True, exist_ok=True)
    made, errors, files = [], {}, {}
    digests = client.map(key, paths, settings=settings, pure=False)
    wait(digests)
    for path, digest in zip(paths, digests):
        if digest.status == "error":
            errors[path] = str(digest.exception())
        else:
            # Two files of the same bytes are one piece of work.
            files[digest.result()] = path
    futures = {client.submit(optimise, path, str(Path(results).resolve()), name, settings, key=f"lumen-{name}"): name
               for name, path in files.items()}
    for future in as_completed(futures):
        name = futures[future]
        if future.status == "error":
            errors[files[name]] = str(future.exception())
        elif future.result():
            made.append(name)
    return files, made, errors


def main():
    surfaces, results, *named = sys.argv[1:]
    named = dict(pair.split("=", 1) for pair in named)
    try:
        lumen.settings(**named)
    except (TypeError, ValueError, lumen.Error) as error:
        sys.exit(f"settings: {error}")
    address = os.environ.get("DASK_SCHEDULER_ADDRESS")
    # Lumen works on all cores by itself: a few workers of one thread keep them busy where it reads and writes.
    with Client(address) if address else Client(n_workers=2, threads_per_worker=1) as client:
        files, made, errors = run(client, surfaces, results, **named)
    total = len(set(files.values()) | set(errors))
    print(f"{total} surfaces: {len(made)} made, {total - len(made) - len(errors)} were there, {len(errors)} failed")
    for path, error in errors.items():
        print(f"{path}: {error}")
    sys.exit(1 if errors else 0)


if __name__ == "__main__":
    main()
