"""What the wheel has that is no module: the workflow, its profiles and the paper's study.

They stand at the top, where Snakemake and its catalogue look for them, and go into the package only as it is built.
"""

from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

BROUGHT = ("workflow", "profiles", "config/paper.yaml")


class WithWorkflow(build_py):
    """The command that gathers the package's files, and these with them."""

    def run(self) -> None:
        """Gather the files; a package that is used where it lies finds them at the top of the repository."""
        super().run()
        if self.editable_mode:
            return
        for name in BROUGHT:
            for source in sorted(path for path in (Path(name), *Path(name).rglob("*")) if path.is_file()):
                target = Path(self.build_lib, "subslide", source)
                target.parent.mkdir(parents=True, exist_ok=True)
                self.copy_file(str(source), str(target))


setup(cmdclass={"build_py": WithWorkflow})
