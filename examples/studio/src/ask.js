// Asks for an operation's result where only the latest of a channel counts; what is stale is not taken.

export async function ask(remote, channel, name, args, take) {
  const result = await remote.latest(channel, () => remote.call(name, args));
  if (result) take(result);
}
