"""What is said on stderr."""
import sys
import time


def say(*words):
    print(f'[{time.strftime("%H:%M:%S")}]', *words, file=sys.stderr, flush=True)


def fail(message):
    print(f'mutation: {message}', file=sys.stderr)
    sys.exit(2)
